// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "foothold/relocalisation/keyframe_relocaliser.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <tuple>
#include <utility>

#include "foothold/base/array.h"
#include "foothold/base/checked_stream.h"
#include "foothold/base/contract.h"
#include "foothold/base/settings.h"
#include "keyframe/fern_encoder.h"

namespace foothold {
namespace {

constexpr BinaryFormat kKeyframeFormat{"scene of a keyframe relocaliser", "FHKEYFRM", 2};

/// The part of the settings that a code depends on; scenes can be read only by a relocaliser with the same.
struct CodeSettings {
  std::int32_t num_ferns;
  std::int32_t encoded_width_px;
  float smoothing_sigma_px;
  float min_threshold_m;
  float max_threshold_m;
  std::uint32_t reserved;
  std::uint64_t seed;
};
static_assert(sizeof(CodeSettings) == 32, "CodeSettings is written to files as bytes");

bool operator==(const CodeSettings& a, const CodeSettings& b) {
  const auto fields = [](const CodeSettings& s) {
    return std::tie(s.num_ferns, s.encoded_width_px, s.smoothing_sigma_px, s.min_threshold_m, s.max_threshold_m, s.reserved, s.seed);
  };
  return fields(a) == fields(b);
}

CodeSettings code_settings(const KeyframeRelocaliserSettings& s) {
  return {s.num_ferns, s.encoded_width_px, s.smoothing_sigma_px, s.min_threshold_m, s.max_threshold_m, 0, s.seed};
}

}  // namespace

void KeyframeRelocaliserSettings::validate() const {
  validate_settings(*this);
  if (min_threshold_m >= max_threshold_m) {
    throw InvalidSettings("setting max_threshold_m: got " + detail::to_text(max_threshold_m) +
                          ", expected more than min_threshold_m, which is " + detail::to_text(min_threshold_m));
  }
}

struct KeyframeRelocaliser::State {
  State(const Context& used_context, const KeyframeRelocaliserSettings& used_settings)
      : context(used_context), settings(used_settings), encoder(used_settings), frame_code(encoder.num_words()) {}

  /// Encodes a frame into frame_code. @return False if it has too little depth.
  bool encode(const Frame& frame);
  /// Fraction of ferns in which the current frame differs from a keyframe.
  float dissimilarity(std::size_t keyframe) const;
  float confidence(float dissimilarity) const;
  /// Warns that a frame would be a keyframe, and there is no room for it.
  void tell_full(const Frame& frame);

  Context context;
  KeyframeRelocaliserSettings settings;
  FernEncoder encoder;
  Array<float> host_depth;                ///< copy of a frame that came in CUDA memory
  std::vector<std::uint64_t> frame_code;  ///< code of the current frame
  std::vector<std::uint64_t> codes;       ///< codes of the keyframes, one after another
  std::vector<SE3> world_from_keyframes;
  std::vector<std::pair<float, std::size_t>> ranking;  ///< (dissimilarity, keyframe), reused between calls
  bool told_full = false;
};

bool KeyframeRelocaliser::State::encode(const Frame& frame) {
  ImageView<const float> depth = frame.depth;
  if (depth.memory != MemoryKind::kHost) {
    context.synchronise();  // the frame may still be on its way on our stream
    host_depth.resize(depth.size());
    detail::copy_memory(MemoryKind::kHost, host_depth.data(), depth.memory, depth.data, depth.size() * sizeof(float));
    depth = {host_depth.data(), depth.width, depth.height, MemoryKind::kHost};
  }
  return encoder.encode(depth, frame_code);
}

float KeyframeRelocaliser::State::dissimilarity(std::size_t keyframe) const {
  const std::size_t num_words = encoder.num_words();
  const int different = count_different_ferns(frame_code.data(), &codes[keyframe * num_words], num_words);
  return static_cast<float>(different) / static_cast<float>(settings.num_ferns);
}

float KeyframeRelocaliser::State::confidence(float dissimilarity) const {
  return 1.0F / (1.0F + std::exp((dissimilarity - settings.confidence_midpoint) / settings.confidence_spread));
}

void KeyframeRelocaliser::State::tell_full(const Frame& frame) {
  told_full = true;
  context.log(LogLevel::kWarning,
              "frame " + std::to_string(frame.index) +
                  " would be a keyframe, but max_keyframes = " + std::to_string(settings.max_keyframes) +
                  " are there; from here on nothing is learnt: the camera is found where it was before, and nowhere else");
}

KeyframeRelocaliser::KeyframeRelocaliser(const Context& context, const KeyframeRelocaliserSettings& settings) {
  settings.validate();
  state_ = std::make_unique<State>(context, settings);
}

KeyframeRelocaliser::~KeyframeRelocaliser() = default;
KeyframeRelocaliser::KeyframeRelocaliser(KeyframeRelocaliser&&) noexcept = default;
KeyframeRelocaliser& KeyframeRelocaliser::operator=(KeyframeRelocaliser&&) noexcept = default;
KeyframeRelocaliser::KeyframeRelocaliser(const KeyframeRelocaliser& other) : state_(std::make_unique<State>(*other.state_)) {}
KeyframeRelocaliser& KeyframeRelocaliser::operator=(const KeyframeRelocaliser& other) {
  state_ = std::make_unique<State>(*other.state_);
  return *this;
}

const KeyframeRelocaliserSettings& KeyframeRelocaliser::settings() const { return state_->settings; }
std::size_t KeyframeRelocaliser::num_keyframes() const { return state_->world_from_keyframes.size(); }
float KeyframeRelocaliser::acceptance_threshold() const { return state_->settings.acceptance_threshold; }

void KeyframeRelocaliser::train(const Frame& frame, const SE3& world_from_camera) {
  FOOTHOLD_EXPECTS_NO_ERROR(describe_frame_error(frame));
  FOOTHOLD_EXPECTS_NO_ERROR(describe_pose_error(world_from_camera));
  State& s = *state_;
  {
    const ScopedStage stage(s.context, "train/encode");
    if (!s.encode(frame)) return;
  }
  const ScopedStage stage(s.context, "train/search");
  const bool is_full = num_keyframes() >= static_cast<std::size_t>(s.settings.max_keyframes);
  if (is_full && s.told_full) return;
  for (std::size_t i = 0; i < num_keyframes(); ++i) {
    if (s.dissimilarity(i) < s.settings.harvest_dissimilarity) return;
  }
  if (is_full) return s.tell_full(frame);
  s.world_from_keyframes.push_back(world_from_camera);
  try {
    s.codes.insert(s.codes.end(), s.frame_code.begin(), s.frame_code.end());
  } catch (...) {  // out of memory: no pose without a code
    s.world_from_keyframes.pop_back();
    throw;
  }
}

std::vector<PoseEstimate> KeyframeRelocaliser::relocalise(const Frame& frame) {
  FOOTHOLD_EXPECTS_NO_ERROR(describe_frame_error(frame));
  State& s = *state_;
  if (num_keyframes() == 0) return {};
  {
    const ScopedStage stage(s.context, "relocalise/encode");
    if (!s.encode(frame)) return {};
  }
  const ScopedStage stage(s.context, "relocalise/search");
  s.ranking.clear();
  for (std::size_t i = 0; i < num_keyframes(); ++i) s.ranking.emplace_back(s.dissimilarity(i), i);
  const auto count = static_cast<std::ptrdiff_t>(std::min(s.ranking.size(), static_cast<std::size_t>(s.settings.num_candidates)));
  std::partial_sort(s.ranking.begin(), s.ranking.begin() + count, s.ranking.end());  // equals: the older keyframe first
  std::vector<PoseEstimate> estimates;
  for (std::ptrdiff_t i = 0; i < count; ++i) {
    const auto& [dissimilarity, keyframe] = s.ranking[static_cast<std::size_t>(i)];
    estimates.push_back({s.world_from_keyframes[keyframe], s.confidence(dissimilarity)});
  }
  return estimates;
}

void KeyframeRelocaliser::reset() {
  state_->codes = std::vector<std::uint64_t>();
  state_->world_from_keyframes = std::vector<SE3>();
  state_->told_full = false;
}

std::size_t KeyframeRelocaliser::state_bytes() const {
  return state_->codes.capacity() * sizeof(std::uint64_t) + state_->world_from_keyframes.capacity() * sizeof(SE3);
}

void KeyframeRelocaliser::save(std::ostream& stream) const {
  CheckedWriter writer(stream, kKeyframeFormat);
  writer.write(code_settings(state_->settings));
  writer.write(static_cast<std::uint64_t>(num_keyframes()));
  for (const SE3& pose : state_->world_from_keyframes) writer.write_transform(pose);
  writer.write_array(state_->codes);
  writer.finish();
}

void KeyframeRelocaliser::load(std::istream& stream) {
  CheckedReader reader(stream, kKeyframeFormat);
  const auto code = reader.read<CodeSettings>("settings");
  const CodeSettings expected = code_settings(state_->settings);
  if (!(code == expected)) {
    reader.refuse("made with other ferns (" + std::to_string(code.num_ferns) + " with seed " + std::to_string(code.seed) +
                  "); expected the settings of this relocaliser (" + std::to_string(expected.num_ferns) + " with seed " +
                  std::to_string(expected.seed) + ", and equal image width, smoothing and thresholds)");
  }
  const auto num_keyframes = reader.read<std::uint64_t>("number of keyframes");
  reader.check_range("keyframes", num_keyframes, 0, static_cast<std::uint64_t>(state_->settings.max_keyframes));
  std::vector<SE3> poses;
  while (poses.size() < num_keyframes) poses.push_back(reader.read_transform("pose"));
  const std::uint64_t num_words = num_keyframes * state_->encoder.num_words();
  auto codes = reader.read_array<std::uint64_t>("words of codes", num_words, num_words);
  reader.finish();
  state_->codes = std::move(codes);
  state_->world_from_keyframes = std::move(poses);
  state_->told_full = false;
}

}  // namespace foothold

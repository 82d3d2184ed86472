// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "foothold/relocalisation/keyframe_relocaliser.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <istream>
#include <ostream>
#include <string>
#include <tuple>
#include <utility>

#include "foothold/base/array.h"
#include "foothold/base/checksum.h"
#include "foothold/base/contract.h"
#include "foothold/base/error.h"
#include "foothold/base/settings.h"
#include "keyframe/fern_encoder.h"

namespace foothold {
namespace {

/// Entries of R^T R - I that a pose may have: single-precision products of rotations that were re-orthonormalised once.
constexpr float kRigidTolerance = 1e-3F;

// A scene: magic, version, the six settings that codes depend on, number of keyframes, codes, poses, checksum; little-endian.
constexpr char kMagic[8] = {'F', 'H', 'K', 'E', 'Y', 'F', 'R', 'M'};
constexpr std::uint32_t kVersion = 1;

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

/// Writes bytes and keeps their FNV-1a checksum.
class ChecksummedWriter {
 public:
  explicit ChecksummedWriter(std::ostream& stream) : stream_(stream) {}
  void write(const void* data, std::size_t num_bytes) {
    stream_.write(static_cast<const char*>(data), static_cast<std::streamsize>(num_bytes));
    checksum_ = fnv1a(checksum_, data, num_bytes);
  }
  std::uint64_t checksum() const { return checksum_; }

 private:
  std::ostream& stream_;
  std::uint64_t checksum_ = kFnvBasis;
};

/// Its counterpart. @throws FileError at the stream's end.
class ChecksummedReader {
 public:
  explicit ChecksummedReader(std::istream& stream) : stream_(stream) {}
  void read(void* data, std::size_t num_bytes) {
    stream_.read(static_cast<char*>(data), static_cast<std::streamsize>(num_bytes));
    if (static_cast<std::size_t>(stream_.gcount()) != num_bytes)
      throw FileError("keyframe scene: the data ends early; expected more bytes");
    checksum_ = fnv1a(checksum_, data, num_bytes);
  }
  template <class T>
  T read() {
    T value{};
    read(&value, sizeof(T));
    return value;
  }
  /// Reads `count` elements, growing as they arrive, so that a damaged count cannot ask for more memory than the stream has bytes.
  template <class T>
  std::vector<T> read_vector(std::size_t count) {
    constexpr std::size_t kChunk = 4096;
    std::vector<T> values;
    while (values.size() < count) {
      const std::size_t begin = values.size();
      values.resize(std::min(count, begin + kChunk));
      read(&values[begin], (values.size() - begin) * sizeof(T));
    }
    return values;
  }
  std::uint64_t checksum() const { return checksum_; }

 private:
  std::istream& stream_;
  std::uint64_t checksum_ = kFnvBasis;
};

}  // namespace

void KeyframeRelocaliserSettings::validate() const {
  validate_settings(*this);
  if (min_threshold_m >= max_threshold_m) {
    throw InvalidSettings("setting max_threshold_m: got " + std::to_string(max_threshold_m) +
                          ", expected more than min_threshold_m, which is " + std::to_string(min_threshold_m));
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

  Context context;
  KeyframeRelocaliserSettings settings;
  FernEncoder encoder;
  Array<float> host_depth;                ///< copy of a frame that came in CUDA memory
  std::vector<std::uint64_t> frame_code;  ///< code of the current frame
  std::vector<std::uint64_t> codes;       ///< codes of the keyframes, one after another
  std::vector<SE3> world_from_keyframes;
  std::vector<std::pair<float, std::size_t>> ranking;  ///< (dissimilarity, keyframe), reused between calls
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
  FOOTHOLD_EXPECTS(describe_frame_error(frame).empty());
  FOOTHOLD_EXPECTS(is_rigid(world_from_camera, kRigidTolerance));
  State& s = *state_;
  {
    const ScopedStage stage(s.context, "train/encode");
    if (!s.encode(frame)) return;
  }
  const ScopedStage stage(s.context, "train/search");
  if (num_keyframes() >= static_cast<std::size_t>(s.settings.max_keyframes)) return;
  for (std::size_t i = 0; i < num_keyframes(); ++i) {
    if (s.dissimilarity(i) < s.settings.harvest_dissimilarity) return;
  }
  s.codes.insert(s.codes.end(), s.frame_code.begin(), s.frame_code.end());
  s.world_from_keyframes.push_back(world_from_camera);
}

std::vector<PoseEstimate> KeyframeRelocaliser::relocalise(const Frame& frame) {
  FOOTHOLD_EXPECTS(describe_frame_error(frame).empty());
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
}

std::size_t KeyframeRelocaliser::state_bytes() const {
  return state_->codes.capacity() * sizeof(std::uint64_t) + state_->world_from_keyframes.capacity() * sizeof(SE3);
}

void KeyframeRelocaliser::save(std::ostream& stream) const {
  ChecksummedWriter writer(stream);
  const CodeSettings code = code_settings(state_->settings);
  const std::uint64_t num_keyframes = this->num_keyframes();
  writer.write(kMagic, sizeof(kMagic));
  writer.write(&kVersion, sizeof(kVersion));
  writer.write(&code, sizeof(code));
  writer.write(&num_keyframes, sizeof(num_keyframes));
  writer.write(state_->codes.data(), state_->codes.size() * sizeof(std::uint64_t));
  writer.write(state_->world_from_keyframes.data(), num_keyframes * sizeof(SE3));
  const std::uint64_t checksum = writer.checksum();
  writer.write(&checksum, sizeof(checksum));
  stream.flush();
  if (!stream) throw FileError("keyframe scene: writing failed after " + std::to_string(num_keyframes) + " keyframes were to be written");
}

void KeyframeRelocaliser::load(std::istream& stream) {
  ChecksummedReader reader(stream);
  char magic[sizeof(kMagic)];
  reader.read(magic, sizeof(magic));
  if (std::memcmp(magic, kMagic, sizeof(kMagic)) != 0)
    throw FileError("keyframe scene: this is something else; expected it to begin with FHKEYFRM");
  const auto version = reader.read<std::uint32_t>();
  if (version != kVersion) throw FileError("keyframe scene: version " + std::to_string(version) + "; expected " + std::to_string(kVersion));
  const auto code = reader.read<CodeSettings>();
  const CodeSettings expected = code_settings(state_->settings);
  if (!(code == expected)) {
    throw FileError("keyframe scene: made with other ferns (" + std::to_string(code.num_ferns) + " with seed " + std::to_string(code.seed) +
                    "); expected the settings of this relocaliser (" + std::to_string(expected.num_ferns) + " with seed " +
                    std::to_string(expected.seed) + ", and equal image width, smoothing and thresholds)");
  }
  const auto num_keyframes = reader.read<std::uint64_t>();
  if (num_keyframes > static_cast<std::uint64_t>(state_->settings.max_keyframes)) {
    throw FileError("keyframe scene: " + std::to_string(num_keyframes) + " keyframes; expected at most " +
                    std::to_string(state_->settings.max_keyframes));
  }
  auto codes = reader.read_vector<std::uint64_t>(num_keyframes * state_->encoder.num_words());
  auto poses = reader.read_vector<SE3>(num_keyframes);
  const std::uint64_t checksum = reader.checksum();
  if (reader.read<std::uint64_t>() != checksum) throw FileError("keyframe scene: the checksum does not match; the data is damaged");
  for (const SE3& pose : poses) {
    if (!is_rigid(pose, kRigidTolerance)) throw FileError("keyframe scene: a pose is not rigid; the data is damaged");
  }
  state_->codes = std::move(codes);
  state_->world_from_keyframes = std::move(poses);
}

}  // namespace foothold

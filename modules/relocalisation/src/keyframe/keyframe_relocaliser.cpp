// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "foothold/relocalisation/keyframe_relocaliser.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <istream>
#include <limits>
#include <ostream>
#include <string>

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
    T value;
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

KeyframeRelocaliser::KeyframeRelocaliser(const Context& context, const KeyframeRelocaliserSettings& settings)
    : context_(context), settings_(settings) {
  settings_.validate();
  encoder_ = std::make_unique<FernEncoder>(settings_);
  frame_code_.resize(encoder_->num_words());
}

KeyframeRelocaliser::~KeyframeRelocaliser() = default;

bool KeyframeRelocaliser::encode(const Frame& frame) {
  ImageView<const float> depth = frame.depth;
  if (depth.memory != MemoryKind::kHost) {
    context_.synchronise();  // the frame may still be on its way on our stream
    host_depth_.resize(depth.size());
    detail::copy_memory(MemoryKind::kHost, host_depth_.data(), depth.memory, depth.data, depth.size() * sizeof(float));
    depth = {host_depth_.data(), depth.width, depth.height, MemoryKind::kHost};
  }
  return encoder_->encode(depth, frame_code_);
}

float KeyframeRelocaliser::dissimilarity(std::size_t keyframe) const {
  const std::size_t num_words = encoder_->num_words();
  const int different = count_different_ferns(frame_code_.data(), &codes_[keyframe * num_words], num_words);
  return static_cast<float>(different) / static_cast<float>(settings_.num_ferns);
}

float KeyframeRelocaliser::nearest_dissimilarity() const {
  float nearest = std::numeric_limits<float>::infinity();
  for (std::size_t i = 0; i < world_from_keyframes_.size(); ++i) nearest = std::min(nearest, dissimilarity(i));
  return nearest;
}

float KeyframeRelocaliser::confidence(float dissimilarity) const {
  return 1.0F / (1.0F + std::exp((dissimilarity - settings_.confidence_midpoint) / settings_.confidence_spread));
}

void KeyframeRelocaliser::train(const Frame& frame, const SE3& world_from_camera) {
  FOOTHOLD_EXPECTS(describe_frame_error(frame).empty());
  FOOTHOLD_EXPECTS(is_rigid(world_from_camera, kRigidTolerance));
  {
    const ScopedStage stage(context_, "train/encode");
    if (!encode(frame)) return;
  }
  const ScopedStage stage(context_, "train/search");
  if (world_from_keyframes_.size() >= static_cast<std::size_t>(settings_.max_keyframes)) return;
  if (nearest_dissimilarity() < settings_.harvest_dissimilarity) return;
  codes_.insert(codes_.end(), frame_code_.begin(), frame_code_.end());
  world_from_keyframes_.push_back(world_from_camera);
}

std::vector<PoseEstimate> KeyframeRelocaliser::relocalise(const Frame& frame) {
  FOOTHOLD_EXPECTS(describe_frame_error(frame).empty());
  if (world_from_keyframes_.empty()) return {};
  {
    const ScopedStage stage(context_, "relocalise/encode");
    if (!encode(frame)) return {};
  }
  const ScopedStage stage(context_, "relocalise/search");
  ranking_.clear();
  for (std::size_t i = 0; i < world_from_keyframes_.size(); ++i) ranking_.emplace_back(dissimilarity(i), i);
  const auto count = static_cast<std::ptrdiff_t>(std::min(ranking_.size(), static_cast<std::size_t>(settings_.num_candidates)));
  std::partial_sort(ranking_.begin(), ranking_.begin() + count, ranking_.end());  // equals: the older keyframe first
  std::vector<PoseEstimate> estimates;
  for (std::ptrdiff_t i = 0; i < count; ++i) {
    const auto& [distance, keyframe] = ranking_[static_cast<std::size_t>(i)];
    estimates.push_back({world_from_keyframes_[keyframe], confidence(distance)});
  }
  return estimates;
}

void KeyframeRelocaliser::reset() {
  codes_.clear();
  codes_.shrink_to_fit();
  world_from_keyframes_.clear();
  world_from_keyframes_.shrink_to_fit();
}

std::size_t KeyframeRelocaliser::state_bytes() const {
  return codes_.capacity() * sizeof(std::uint64_t) + world_from_keyframes_.capacity() * sizeof(SE3);
}

float KeyframeRelocaliser::acceptance_threshold() const { return settings_.acceptance_threshold; }

void KeyframeRelocaliser::save(std::ostream& stream) const {
  ChecksummedWriter writer(stream);
  const CodeSettings code = code_settings(settings_);
  const std::uint64_t num_keyframes = world_from_keyframes_.size();
  writer.write(kMagic, sizeof(kMagic));
  writer.write(&kVersion, sizeof(kVersion));
  writer.write(&code, sizeof(code));
  writer.write(&num_keyframes, sizeof(num_keyframes));
  writer.write(codes_.data(), codes_.size() * sizeof(std::uint64_t));
  writer.write(world_from_keyframes_.data(), world_from_keyframes_.size() * sizeof(SE3));
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
  const CodeSettings expected = code_settings(settings_);
  if (std::memcmp(&code, &expected, sizeof(code)) != 0) {
    throw FileError("keyframe scene: made with other ferns (" + std::to_string(code.num_ferns) + " with seed " + std::to_string(code.seed) +
                    "); expected the settings of this relocaliser (" + std::to_string(expected.num_ferns) + " with seed " +
                    std::to_string(expected.seed) + ", and equal image width, smoothing and thresholds)");
  }
  const auto num_keyframes = reader.read<std::uint64_t>();
  if (num_keyframes > static_cast<std::uint64_t>(settings_.max_keyframes)) {
    throw FileError("keyframe scene: " + std::to_string(num_keyframes) + " keyframes; expected at most " +
                    std::to_string(settings_.max_keyframes));
  }
  auto codes = reader.read_vector<std::uint64_t>(num_keyframes * encoder_->num_words());
  auto poses = reader.read_vector<SE3>(num_keyframes);
  const std::uint64_t checksum = reader.checksum();
  if (reader.read<std::uint64_t>() != checksum) throw FileError("keyframe scene: the checksum does not match; the data is damaged");
  for (const SE3& pose : poses) {
    if (!is_rigid(pose, kRigidTolerance)) throw FileError("keyframe scene: a pose is not rigid; the data is damaged");
  }
  codes_ = std::move(codes);
  world_from_keyframes_ = std::move(poses);
}

}  // namespace foothold

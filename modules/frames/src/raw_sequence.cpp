// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "foothold/frames/raw_sequence.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <fstream>
#include <utility>
#include <vector>

#include "foothold/base/checked_stream.h"
#include "foothold/base/contract.h"

namespace foothold {
namespace {

constexpr BinaryFormat kHeadFormat{"raw recording", "FHRAWSEQ", 2};
constexpr BinaryFormat kFrameFormat{"frame of a raw recording", "FHRAWFRM", 1};
constexpr BinaryFormat kTailFormat{"end of a raw recording", "FHRAWEND", 1};
constexpr float kUnitsPerMetre = 5000.0F;  // a multiple of whole millimetres, and what TUM's recordings hold
constexpr float kMaxUnits = 65535.0F;
constexpr int kMaxSide = 16384;
constexpr std::uint64_t kMaxFrames = 1U << 30U;

constexpr std::uint64_t kTransformBytes = 12 * sizeof(float);
constexpr std::uint64_t kHeadBytes = checked_size(2 * sizeof(std::int32_t) + 2 * sizeof(Intrinsics) + kTransformBytes);
constexpr std::uint64_t kTailBytes = checked_size(sizeof(std::uint64_t));

std::uint64_t bytes_per_frame(std::uint64_t num_pixels) {
  constexpr std::uint64_t kFixedBytes = sizeof(std::int64_t) + sizeof(double) + sizeof(std::uint8_t) + kTransformBytes;
  return checked_size(kFixedBytes + num_pixels * (sizeof(std::uint16_t) + sizeof(Rgb8)));
}

/// What holds for all frames.
struct Head {
  int width = 0;
  int height = 0;
  RgbdCalibration calibration;
  std::uint64_t checksum = 0;  ///< with which each frame goes on

  std::uint64_t num_pixels() const { return static_cast<std::uint64_t>(width) * static_cast<std::uint64_t>(height); }
};

std::uint64_t write_head(std::ostream& stream, const RgbdFrame& frame) {
  CheckedWriter writer(stream, kHeadFormat);
  writer.write(std::int32_t{frame.depth.width()});
  writer.write(std::int32_t{frame.depth.height()});
  writer.write(frame.calibration.depth);
  writer.write(frame.calibration.colour);
  writer.write_transform(frame.calibration.depth_from_colour);
  return writer.finish();
}

Head read_head(std::istream& stream, const std::string& path) {
  CheckedReader reader(stream, kHeadFormat, path);
  Head head;
  head.width = reader.read<std::int32_t>("width");
  head.height = reader.read<std::int32_t>("height");
  for (const int side : {head.width, head.height}) {
    if (side < 1 || side > kMaxSide) {
      reader.refuse("got images of " + std::to_string(head.width) + "x" + std::to_string(head.height) + " pixels, expected sides of 1 to " +
                    std::to_string(kMaxSide));
    }
  }
  head.calibration.depth = reader.read<Intrinsics>("depth intrinsics");
  head.calibration.colour = reader.read<Intrinsics>("colour intrinsics");
  head.calibration.depth_from_colour = reader.read_transform("transform from colour to depth");
  if (!is_valid(head.calibration.depth) || !is_valid(head.calibration.colour)) {
    reader.refuse("got a calibration that is none, expected positive focal lengths and finite values");
  }
  head.checksum = reader.finish();
  return head;
}

class RawSequence final : public Sequence {
 public:
  RawSequence(std::string path, const Head& head, int num_frames) : path_(std::move(path)), head_(head), num_frames_(num_frames) {}

  std::string name() const override { return path_.substr(path_.find_last_of('/') + 1); }
  int num_frames() const override { return num_frames_; }
  RgbdFrame load(int index) const override;

 private:
  std::string path_;
  Head head_;
  int num_frames_;
};

RgbdFrame RawSequence::load(int index) const {
  FOOTHOLD_EXPECTS(index >= 0 && index < num_frames_);
  std::ifstream stream(path_, std::ios::binary);  // one for each call, so that several threads may load
  stream.seekg(static_cast<std::streamoff>(kHeadBytes + bytes_per_frame(head_.num_pixels()) * static_cast<std::uint64_t>(index)));
  CheckedReader reader(stream, kFrameFormat, path_ + ": frame " + std::to_string(index), head_.checksum);
  RgbdFrame frame;
  frame.index = reader.read<std::int64_t>("index");
  frame.timestamp_s = reader.read<double>("time");
  const bool has_pose = reader.read<std::uint8_t>("pose") != 0;
  const SE3 world_from_camera = reader.read_transform("pose");
  if (has_pose) frame.world_from_camera = world_from_camera;
  frame.calibration = head_.calibration;
  frame.depth = Image<float>(head_.width, head_.height);
  frame.colour = Image<Rgb8>(head_.width, head_.height);
  const auto units = reader.read_items<std::uint16_t>("depth", head_.num_pixels());
  std::transform(units.begin(), units.end(), frame.depth.data(),
                 [](std::uint16_t unit) { return static_cast<float>(unit) / kUnitsPerMetre; });
  reader.read_bytes(frame.colour.data(), frame.colour.size() * sizeof(Rgb8), "colour");
  reader.finish();
  return frame;
}

}  // namespace

void RawSequenceWriter::write(const RgbdFrame& frame) {
  FOOTHOLD_EXPECTS_NO_ERROR(describe_frame_error(frame.view()));
  if (num_frames_ == 0) {
    width_ = frame.depth.width();
    height_ = frame.depth.height();
    calibration_ = frame.calibration;
    head_checksum_ = write_head(stream_, frame);
  }
  FOOTHOLD_EXPECTS(frame.depth.width() == width_ && frame.depth.height() == height_ && same_calibration(frame.calibration, calibration_));
  std::vector<std::uint16_t> units(frame.depth.size());
  std::transform(frame.depth.data(), frame.depth.data() + frame.depth.size(), units.begin(), [](float depth_m) {
    const float value = is_valid_depth(depth_m) ? std::floor(depth_m * kUnitsPerMetre + 0.5F) : 0.0F;
    return static_cast<std::uint16_t>(value <= kMaxUnits ? value : 0.0F);
  });
  CheckedWriter writer(stream_, kFrameFormat, head_checksum_);
  writer.write(frame.index);
  writer.write(frame.timestamp_s);
  writer.write(frame.world_from_camera.has_value());
  writer.write_transform(frame.world_from_camera.value_or(SE3{}));
  writer.write_bytes(units.data(), units.size() * sizeof(std::uint16_t));
  writer.write_bytes(frame.colour.data(), frame.colour.size() * sizeof(Rgb8));
  writer.finish();
  ++num_frames_;
}

void RawSequenceWriter::finish() {
  FOOTHOLD_EXPECTS(num_frames_ > 0);
  CheckedWriter writer(stream_, kTailFormat, head_checksum_);
  writer.write(static_cast<std::uint64_t>(num_frames_));
  writer.finish();
}

bool is_raw_sequence(const std::string& path) {
  std::ifstream stream(path, std::ios::binary);
  std::string magic(std::strlen(kHeadFormat.magic), '\0');
  stream.read(magic.data(), static_cast<std::streamsize>(magic.size()));
  return stream && magic == kHeadFormat.magic;
}

std::unique_ptr<Sequence> open_raw_sequence(const std::string& path) {
  std::ifstream stream(path, std::ios::binary);
  if (!stream) throw FileError(path + ": cannot be opened; expected a raw recording");
  const Head head = read_head(stream, path);
  stream.seekg(0, std::ios::end);
  const auto num_bytes = static_cast<std::uint64_t>(std::streamoff(stream.tellg()));
  const std::uint64_t frame_bytes = bytes_per_frame(head.num_pixels());
  const std::uint64_t num_frames = num_bytes < kHeadBytes + kTailBytes ? 0 : (num_bytes - kHeadBytes - kTailBytes) / frame_bytes;
  if (num_frames < 1 || num_frames > kMaxFrames || kHeadBytes + num_frames * frame_bytes + kTailBytes != num_bytes) {
    throw FileError(path + ": unfinished or damaged: got " + std::to_string(num_bytes) +
                    " bytes, which hold no whole number of frames of " + std::to_string(frame_bytes) + " bytes");
  }
  stream.seekg(static_cast<std::streamoff>(num_bytes - kTailBytes));
  CheckedReader tail(stream, kTailFormat, path, head.checksum);
  const auto expected = tail.read<std::uint64_t>("number of frames");
  tail.check_range("frames", num_frames, expected, expected);
  tail.finish();
  return std::make_unique<RawSequence>(path, head, static_cast<int>(num_frames));
}

}  // namespace foothold

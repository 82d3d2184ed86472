// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "foothold/api/raw_sequence.h"

#include <cmath>
#include <cstring>
#include <fstream>
#include <utility>
#include <vector>

#include "foothold/base/contract.h"
#include "foothold/base/error.h"

namespace foothold {
namespace {

constexpr char kMagic[8] = {'F', 'H', 'R', 'A', 'W', 'S', 'E', 'Q'};
constexpr std::uint32_t kVersion = 1;
constexpr float kUnitsPerMetre = 5000.0F;  // a multiple of whole millimetres, and what TUM's recordings hold
constexpr float kMaxUnits = 65535.0F;
constexpr int kMaxSide = 16384;

/// The file's first bytes, little endian as every supported machine.
struct Header {
  char magic[8];
  std::uint32_t version;
  std::int32_t num_frames;  ///< 0 until finish()
  std::int32_t width;
  std::int32_t height;
  float depth_intrinsics[4];
  float colour_intrinsics[4];
  float depth_from_colour[12];  ///< rotation row by row, then translation
};
static_assert(sizeof(Header) == 104, "read and written as bytes");

/// What stands before a frame's images.
struct FrameHeader {
  std::int64_t index;
  double timestamp_s;
  float world_from_camera[12];
  std::int32_t has_pose;
  std::int32_t reserved;
};
static_assert(sizeof(FrameHeader) == 72, "read and written as bytes");

void pack(const SE3& transform, float* values) {
  for (int i = 0; i < 9; ++i) values[i] = transform.rotation(i / 3, i % 3);
  for (int i = 0; i < 3; ++i) values[9 + i] = transform.translation[i];
}

SE3 unpack(const float* values) {
  SE3 transform;
  for (int i = 0; i < 9; ++i) transform.rotation(i / 3, i % 3) = values[i];
  for (int i = 0; i < 3; ++i) transform.translation[i] = values[9 + i];
  return transform;
}

void pack(const Intrinsics& intrinsics, float* values) {
  const float all[4] = {intrinsics.fx, intrinsics.fy, intrinsics.cx, intrinsics.cy};
  std::memcpy(values, all, sizeof(all));
}

Intrinsics unpack_intrinsics(const float* values) { return {values[0], values[1], values[2], values[3]}; }

std::uint64_t bytes_per_frame(const Header& header) {
  const auto num_pixels = static_cast<std::uint64_t>(header.width) * static_cast<std::uint64_t>(header.height);
  return sizeof(FrameHeader) + num_pixels * (sizeof(std::uint16_t) + sizeof(Rgb8));
}

[[noreturn]] void fail(const std::string& path, const std::string& what, const std::string& expected) {
  throw FileError(path + ": got " + what + ", expected " + expected);
}

class RawSequence final : public Sequence {
 public:
  RawSequence(std::string path, const Header& header) : path_(std::move(path)), header_(header) {}

  std::string name() const override { return path_.substr(path_.find_last_of('/') + 1); }
  int num_frames() const override { return header_.num_frames; }
  RgbdFrame load(int index) const override;

 private:
  std::string path_;
  Header header_;
};

RgbdFrame RawSequence::load(int index) const {
  FOOTHOLD_EXPECTS(index >= 0 && index < header_.num_frames);
  std::ifstream stream(path_, std::ios::binary);  // one for each call, so that several threads may load
  stream.seekg(static_cast<std::streamoff>(sizeof(Header) + bytes_per_frame(header_) * static_cast<std::uint64_t>(index)));
  FrameHeader frame_header{};
  stream.read(reinterpret_cast<char*>(&frame_header), sizeof(frame_header));
  RgbdFrame frame;
  frame.depth = Image<float>(header_.width, header_.height);
  frame.colour = Image<Rgb8>(header_.width, header_.height);
  std::vector<std::uint16_t> units(frame.depth.size());
  stream.read(reinterpret_cast<char*>(units.data()), static_cast<std::streamsize>(units.size() * sizeof(std::uint16_t)));
  stream.read(reinterpret_cast<char*>(frame.colour.data()), static_cast<std::streamsize>(frame.colour.size() * sizeof(Rgb8)));
  if (!stream) fail(path_, "no frame " + std::to_string(index), std::to_string(header_.num_frames) + " frames");
  for (std::size_t i = 0; i < units.size(); ++i) frame.depth.data()[i] = static_cast<float>(units[i]) / kUnitsPerMetre;
  frame.calibration = {unpack_intrinsics(header_.depth_intrinsics), unpack_intrinsics(header_.colour_intrinsics),
                       unpack(header_.depth_from_colour)};
  frame.index = frame_header.index;
  frame.timestamp_s = frame_header.timestamp_s;
  if (frame_header.has_pose == 0) return frame;
  frame.world_from_camera = unpack(frame_header.world_from_camera);
  if (!is_rigid(*frame.world_from_camera, 1e-2F))
    fail(path_, "a pose of frame " + std::to_string(index) + " that is not rigid", "one that is");
  return frame;
}

}  // namespace

void RawSequenceWriter::write(const RgbdFrame& frame) {
  FOOTHOLD_EXPECTS(describe_frame_error(frame.view()).empty());
  if (num_frames_ == 0) {
    begin_ = stream_.tellp();
    width_ = frame.depth.width();
    height_ = frame.depth.height();
    calibration_ = frame.calibration;
    const Header unfinished{};
    stream_.write(reinterpret_cast<const char*>(&unfinished), sizeof(unfinished));
  }
  FOOTHOLD_EXPECTS(frame.depth.width() == width_ && frame.depth.height() == height_ && same_calibration(frame.calibration, calibration_));
  FrameHeader header{};
  header.index = frame.index;
  header.timestamp_s = frame.timestamp_s;
  header.has_pose = frame.world_from_camera.has_value() ? 1 : 0;
  pack(frame.world_from_camera.value_or(SE3{}), header.world_from_camera);
  std::vector<std::uint16_t> units(frame.depth.size());
  for (std::size_t i = 0; i < units.size(); ++i) {
    const float depth_m = frame.depth.data()[i];
    const float value = is_valid_depth(depth_m) ? std::floor(depth_m * kUnitsPerMetre + 0.5F) : 0.0F;
    units[i] = static_cast<std::uint16_t>(value <= kMaxUnits ? value : 0.0F);
  }
  stream_.write(reinterpret_cast<const char*>(&header), sizeof(header));
  stream_.write(reinterpret_cast<const char*>(units.data()), static_cast<std::streamsize>(units.size() * sizeof(std::uint16_t)));
  stream_.write(reinterpret_cast<const char*>(frame.colour.data()), static_cast<std::streamsize>(frame.colour.size() * sizeof(Rgb8)));
  if (!stream_) throw FileError("raw recording: frame " + std::to_string(num_frames_) + " could not be written; is the disk full?");
  ++num_frames_;
}

void RawSequenceWriter::finish() {
  FOOTHOLD_EXPECTS(num_frames_ > 0);
  Header header{};
  std::memcpy(header.magic, kMagic, sizeof(kMagic));
  header.version = kVersion;
  header.num_frames = num_frames_;
  header.width = width_;
  header.height = height_;
  pack(calibration_.depth, header.depth_intrinsics);
  pack(calibration_.colour, header.colour_intrinsics);
  pack(calibration_.depth_from_colour, header.depth_from_colour);
  stream_.seekp(begin_);
  stream_.write(reinterpret_cast<const char*>(&header), sizeof(header));
  stream_.flush();
  if (!stream_) throw FileError("raw recording: the header could not be written; is the disk full?");
}

bool is_raw_sequence(const std::string& path) {
  std::ifstream stream(path, std::ios::binary);
  char magic[sizeof(kMagic)] = {};
  stream.read(magic, sizeof(magic));
  return stream && std::memcmp(magic, kMagic, sizeof(kMagic)) == 0;
}

std::unique_ptr<Sequence> open_raw_sequence(const std::string& path) {
  std::ifstream stream(path, std::ios::binary | std::ios::ate);
  if (!stream) throw FileError(path + ": cannot be opened; expected a raw recording");
  const auto num_bytes = static_cast<std::uint64_t>(stream.tellg());
  stream.seekg(0);
  Header header{};
  stream.read(reinterpret_cast<char*>(&header), sizeof(header));
  if (!stream || std::memcmp(header.magic, kMagic, sizeof(kMagic)) != 0) {
    fail(path, "other or unfinished first bytes", "a raw recording, as render_sequence --raw writes it");
  }
  if (header.version != kVersion) fail(path, "version " + std::to_string(header.version), std::to_string(kVersion));
  if (header.width < 1 || header.width > kMaxSide || header.height < 1 || header.height > kMaxSide || header.num_frames < 1) {
    fail(path,
         std::to_string(header.num_frames) + " frames of " + std::to_string(header.width) + "x" + std::to_string(header.height) + " pixels",
         "at least one frame, of sides up to " + std::to_string(kMaxSide));
  }
  const std::uint64_t expected = sizeof(Header) + bytes_per_frame(header) * static_cast<std::uint64_t>(header.num_frames);
  if (num_bytes != expected) fail(path, std::to_string(num_bytes) + " bytes", std::to_string(expected));
  if (!is_valid(unpack_intrinsics(header.depth_intrinsics)) || !is_valid(unpack_intrinsics(header.colour_intrinsics)) ||
      !is_rigid(unpack(header.depth_from_colour), 1e-2F)) {
    fail(path, "a calibration that is none", "positive focal lengths and a rigid transform");
  }
  return std::make_unique<RawSequence>(path, header);
}

}  // namespace foothold

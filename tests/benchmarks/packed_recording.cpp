// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "packed_recording.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <fstream>
#include <ostream>
#include <vector>

#include "foothold/base/contract.h"
#include "foothold/base/error.h"
#include "range_coder.h"

namespace foothold::benchmark {
namespace {

constexpr char kMagic[8] = {'F', 'H', 'P', 'A', 'C', 'K', 'E', 'D'};
constexpr unsigned kDroppedBits = 3;  ///< of each channel of colour
constexpr float kUnitsPerMetre = 1000.0F;
constexpr int kMaxUnits = 65535;

struct Header {
  char magic[8];
  std::int32_t num_frames;
  std::int32_t width;
  std::int32_t height;
  RgbdCalibration calibration;
};

struct FrameHeader {
  std::int64_t index;
  double timestamp_s;
  SE3 world_from_camera;
  std::int32_t has_pose;
  std::uint32_t num_bytes;  ///< of the coded images that follow
};

/// A plane of whole numbers, with what lies outside as zero.
class Plane {
 public:
  Plane(int width, int height) : width_(width), values_(static_cast<std::size_t>(width) * static_cast<std::size_t>(height)) {}
  int& operator()(int u, int v) {
    return values_[static_cast<std::size_t>(v) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(u)];
  }
  int at(int u, int v) { return u < 0 || v < 0 ? 0 : (*this)(u, v); }

 private:
  int width_;
  std::vector<int> values_;
};

/// A pixel's neighbours that are known already: left, above, and between the two.
struct Neighbours {
  int left;
  int above;
  int corner;

  /// The median of left, above and the plane through all three [Weinberger2000].
  int prediction() const {
    const int low = std::min(left, above);
    const int high = std::max(left, above);
    return corner >= high ? low : corner <= low ? high : left + above - corner;
  }
  /// How uneven the image is here, in steps that double: [0, kNumLevels).
  int unevenness() const {
    const int difference = std::abs(left - corner) + std::abs(corner - above);
    int level = 0;
    while (level + 1 < kNumLevels && difference >= (1 << level)) ++level;
    return level;
  }
  static constexpr int kNumLevels = 10;
};

Neighbours neighbours_of(Plane& plane, int u, int v) { return {plane.at(u - 1, v), plane.at(u, v - 1), plane.at(u - 1, v - 1)}; }

/// Codes images of one size, one pixel after another; with a BitEncoder reads them, with a BitDecoder fills them.
class ImageCoder {
 public:
  template <class Coder>
  void code(Coder& coder, Image<float>& depth, Image<Rgb8>& colour) {
    Plane units(depth.width(), depth.height());
    Plane green(depth.width(), depth.height());
    Plane red(depth.width(), depth.height());   // less green
    Plane blue(depth.width(), depth.height());  // less green
    for (int v = 0; v < depth.height(); ++v) {
      for (int u = 0; u < depth.width(); ++u) {
        code_depth(coder, units, u, v, depth(u, v));
        Rgb8& pixel = colour(u, v);
        const int g = pixel.g >> kDroppedBits;
        green(u, v) = code_colour(coder, green, 0, u, v, g);
        red(u, v) = code_colour(coder, red, 1, u, v, (pixel.r >> kDroppedBits) - g);
        blue(u, v) = code_colour(coder, blue, 2, u, v, (pixel.b >> kDroppedBits) - g);
        pixel = {channel(green(u, v) + red(u, v)), channel(green(u, v)), channel(green(u, v) + blue(u, v))};
      }
    }
  }

 private:
  static std::uint8_t channel(int steps) { return static_cast<std::uint8_t>((steps << kDroppedBits | 1 << (kDroppedBits - 1)) & 255); }

  template <class Coder>
  void code_depth(Coder& coder, Plane& units, int u, int v, float& depth_m) {
    const Neighbours near = neighbours_of(units, u, v);
    const float rounded = is_valid_depth(depth_m) ? std::floor(depth_m * kUnitsPerMetre + 0.5F) : 0.0F;
    int value = rounded <= static_cast<float>(kMaxUnits) ? static_cast<int>(rounded) : 0;
    const unsigned valid = (near.left != 0 ? 1U : 0U) + (near.above != 0 ? 2U : 0U) + (near.corner != 0 ? 4U : 0U);
    bool is_there = value != 0;
    coder.code(is_there, is_depth_[valid]);
    if (!is_there) {
      units(u, v) = 0;
      depth_m = 0.0F;
      return;
    }
    const bool all_valid = valid == 7U;
    const int prediction = all_valid ? near.prediction() : near.left != 0 ? near.left : near.above != 0 ? near.above : last_units_;
    int residual = value - prediction;
    depth_[all_valid ? near.unevenness() : Neighbours::kNumLevels].code(coder, residual);
    value = std::clamp(prediction + residual, 0, kMaxUnits);
    units(u, v) = last_units_ = value;
    depth_m = static_cast<float>(value) / kUnitsPerMetre;
  }

  template <class Coder>
  int code_colour(Coder& coder, Plane& plane, int which, int u, int v, int value) {
    const Neighbours near = neighbours_of(plane, u, v);
    int residual = value - near.prediction();
    colour_[which][near.unevenness()].code(coder, residual);
    return near.prediction() + residual;
  }

  BitModel is_depth_[8];
  NumberModel depth_[Neighbours::kNumLevels + 1];
  NumberModel colour_[3][Neighbours::kNumLevels];
  int last_units_ = 0;
};

template <class T>
void write_bytes(std::ostream& stream, const T& value) {
  stream.write(reinterpret_cast<const char*>(&value), sizeof(value));
}

template <class T>
bool read_bytes(std::istream& stream, T& value) {
  return static_cast<bool>(stream.read(reinterpret_cast<char*>(&value), sizeof(value)));
}

class PackedRecording final : public Sequence {
 public:
  PackedRecording(std::string path, const Header& header, std::vector<std::streamoff> frame_offsets)
      : path_(std::move(path)), header_(header), frame_offsets_(std::move(frame_offsets)) {}

  std::string name() const override { return path_.substr(path_.find_last_of('/') + 1); }
  int num_frames() const override { return static_cast<int>(frame_offsets_.size()); }
  RgbdFrame load(int index) const override {
    FOOTHOLD_EXPECTS(index >= 0 && index < num_frames());
    std::ifstream stream(path_, std::ios::binary);  // one for each call, so that several threads may load
    stream.seekg(frame_offsets_[static_cast<std::size_t>(index)]);
    FrameHeader header{};
    if (!read_bytes(stream, header)) throw FileError(path_ + ": ends before frame " + std::to_string(index));
    std::vector<std::uint8_t> bytes(header.num_bytes);
    if (!stream.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()))) {
      throw FileError(path_ + ": ends within frame " + std::to_string(index));
    }
    RgbdFrame frame;
    frame.depth = Image<float>(header_.width, header_.height);
    frame.colour = Image<Rgb8>(header_.width, header_.height);
    BitDecoder decoder(bytes.data(), bytes.data() + bytes.size());
    ImageCoder().code(decoder, frame.depth, frame.colour);
    frame.calibration = header_.calibration;
    frame.index = header.index;
    frame.timestamp_s = header.timestamp_s;
    if (header.has_pose != 0) frame.world_from_camera = header.world_from_camera;
    return frame;
  }

 private:
  std::string path_;
  Header header_;
  std::vector<std::streamoff> frame_offsets_;
};

}  // namespace

void pack_recording(const Sequence& sequence, int num_frames, std::ostream& stream) {
  num_frames = std::min(num_frames, sequence.num_frames());
  for (int i = 0; i < num_frames; ++i) {
    RgbdFrame frame = sequence.load(i);
    if (i == 0) {
      Header header{{}, num_frames, frame.depth.width(), frame.depth.height(), frame.calibration};
      std::memcpy(header.magic, kMagic, sizeof(kMagic));
      write_bytes(stream, header);
    }
    BitEncoder encoder;
    ImageCoder().code(encoder, frame.depth, frame.colour);
    const std::vector<std::uint8_t> bytes = encoder.finish();
    write_bytes(stream, FrameHeader{frame.index, frame.timestamp_s, frame.world_from_camera.value_or(SE3{}),
                                    frame.world_from_camera.has_value() ? 1 : 0, static_cast<std::uint32_t>(bytes.size())});
    stream.write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  }
  stream.flush();
  if (!stream) throw FileError("packed recording: could not be written; is the disk full?");
}

bool is_packed_recording(const std::string& path) {
  std::ifstream stream(path, std::ios::binary);
  char magic[sizeof(kMagic)] = {};
  return read_bytes(stream, magic) && std::memcmp(magic, kMagic, sizeof(kMagic)) == 0;
}

std::unique_ptr<Sequence> open_packed_recording(const std::string& path) {
  std::ifstream stream(path, std::ios::binary);
  Header header{};
  constexpr int kMaxSide = 16384;
  if (!read_bytes(stream, header) || std::memcmp(header.magic, kMagic, sizeof(kMagic)) != 0 || header.num_frames < 1 || header.width < 1 ||
      header.width > kMaxSide || header.height < 1 || header.height > kMaxSide) {
    throw FileError(path + ": got other first bytes, expected a packed recording, as device_benchmark pack writes it");
  }
  std::vector<std::streamoff> offsets;
  FrameHeader frame{};
  for (std::streamoff offset = sizeof(Header); static_cast<int>(offsets.size()) < header.num_frames;
       offset += sizeof(frame) + frame.num_bytes) {
    stream.seekg(offset);
    if (!read_bytes(stream, frame)) {
      throw FileError(path + ": got " + std::to_string(offsets.size()) + " frames, expected " + std::to_string(header.num_frames));
    }
    offsets.push_back(offset);
  }
  return std::make_unique<PackedRecording>(path, header, std::move(offsets));
}

}  // namespace foothold::benchmark

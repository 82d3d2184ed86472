// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// A sequence whose every pixel is known in closed form, so that tests can tell one millimetre and one frame from the next.
#pragma once

#include <algorithm>
#include <cstdint>
#include <string>

#include "foothold/api/frame_source.h"
#include "foothold/base/error.h"

namespace foothold::virtual_camera {

/// A slanted plane that moves with the frame number, with a column without depth at the left edge.
class PatternSequence : public Sequence {
 public:
  /// Reads "WIDTHxHEIGHT", or the default of 640x480 if the text is empty. @throws InvalidSettings for anything else.
  explicit PatternSequence(const std::string& size) {
    if (size.empty()) return;
    const std::size_t cross = size.find('x');
    width_ = cross == std::string::npos ? 0 : parse(size.substr(0, cross));
    height_ = cross == std::string::npos ? 0 : parse(size.substr(cross + 1));
    if (width_ == 0 || height_ == 0) {
      throw InvalidSettings("pattern:" + size + ": expected pattern:WIDTHxHEIGHT with even sizes in [16, 1280], e.g. pattern:320x240");
    }
  }

  /// Depth [mm] of the pattern; 0 in the first column.
  static int depth_mm(int u, int v, int frame) { return u == 0 ? 0 : 500 + (4 * u + 3 * v + 11 * frame) % 4000; }
  /// Colour of the pattern; its blue channel is the frame number.
  static Rgb8 colour(int u, int v, int frame) {
    return {static_cast<std::uint8_t>(u + 5 * frame), static_cast<std::uint8_t>(v), static_cast<std::uint8_t>(frame)};
  }
  /// A camera whose focal length is its width, with a centred principal point.
  static Intrinsics intrinsics(int width, int height) {
    const auto focal_length_px = static_cast<float>(width);
    return {focal_length_px, focal_length_px, 0.5F * static_cast<float>(width - 1), 0.5F * static_cast<float>(height - 1)};
  }

  std::string name() const override { return "pattern:" + std::to_string(width_) + "x" + std::to_string(height_); }
  int num_frames() const override { return 100000; }
  RgbdFrame load(int index) const override {
    RgbdFrame frame;
    frame.depth = Image<float>(width_, height_);
    frame.colour = Image<Rgb8>(width_, height_);
    for (int v = 0; v < height_; ++v) {
      for (int u = 0; u < width_; ++u) {
        frame.depth(u, v) = 0.001F * static_cast<float>(depth_mm(u, v, index));
        frame.colour(u, v) = colour(u, v, index);
      }
    }
    frame.calibration.depth = intrinsics(width_, height_);
    frame.calibration.colour = frame.calibration.depth;
    frame.index = index;
    return frame;
  }

 private:
  static int parse(const std::string& text) {
    if (text.empty() || text.size() > 4 || text.find_first_not_of("0123456789") != std::string::npos) return 0;
    const int value = std::stoi(text);
    return value >= 16 && value <= 1280 && value % 2 == 0 ? value : 0;
  }

  int width_ = 640;
  int height_ = 480;
};

}  // namespace foothold::virtual_camera

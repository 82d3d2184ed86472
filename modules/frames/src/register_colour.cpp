// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "foothold/frames/register_colour.h"

#include <Eigen/LU>
#include <algorithm>
#include <cstdint>
#include <vector>

#include "foothold/base/contract.h"

namespace foothold {
namespace {

/// About the median of the valid depths [m], from a sixteenth of them; 2 m, amid the range of depth cameras, if there is none.
float median_depth_m(const ImageView<const float>& depth) {
  constexpr int kStep = 4;
  std::vector<float> valid;
  for (int v = 0; v < depth.height; v += kStep) {
    for (int u = 0; u < depth.width; u += kStep) {
      if (is_valid_depth(depth(u, v))) valid.push_back(depth(u, v));
    }
  }
  if (valid.empty()) return 2.0F;
  const auto middle = valid.begin() + static_cast<std::ptrdiff_t>(valid.size() / 2);
  std::nth_element(valid.begin(), middle, valid.end());
  return *middle;
}

/// Steps between two neighbouring pixels of the colour image.
constexpr int kSteps = 64;

/// A colour image to be read between its pixels. A pixel's channels stand 21 bits apart in one number, so that one multiplication by a
/// weight of up to kSteps^2 = 2^12 does for all three: 8 + 12 bits, and one for rounding.
class SpreadColour {
 public:
  /// Repeats the last column and row once, so that every position in the image has four neighbours.
  explicit SpreadColour(const ColourView& colour) : stride_(static_cast<std::size_t>(colour.width) + 1) {
    const auto bytes_per_pixel = static_cast<std::size_t>(colour.bytes_per_pixel);
    const std::size_t bytes_per_row = static_cast<std::size_t>(colour.width) * bytes_per_pixel;
    pixels_.reserve(stride_ * (static_cast<std::size_t>(colour.height) + 1));
    for (int v = 0; v <= colour.height; ++v) {
      const std::uint8_t* row = colour.data + static_cast<std::size_t>(std::min(v, colour.height - 1)) * bytes_per_row;
      for (std::size_t byte = 0; byte < bytes_per_row; byte += bytes_per_pixel) pixels_.push_back(spread(row + byte));
      pixels_.push_back(pixels_.back());
    }
  }

  /// The colour at a position, counted in steps.
  Rgb8 at(int u_steps, int v_steps) const {
    constexpr std::uint64_t kHalf = kSteps * kSteps / 2;
    const std::uint64_t* p = &pixels_[static_cast<std::size_t>(v_steps / kSteps) * stride_ + static_cast<std::size_t>(u_steps / kSteps)];
    const auto a = static_cast<std::uint64_t>(u_steps % kSteps);
    const auto b = static_cast<std::uint64_t>(v_steps % kSteps);
    const std::uint64_t sum = (kSteps - b) * ((kSteps - a) * p[0] + a * p[1]) + b * ((kSteps - a) * p[stride_] + a * p[stride_ + 1]) +
                              (kHalf | kHalf << kApart | kHalf << 2 * kApart);
    const auto channel = [sum](int index) { return static_cast<std::uint8_t>(sum >> (index * kApart + 12)); };
    return {channel(0), channel(1), channel(2)};
  }

 private:
  static constexpr int kApart = 21;

  static std::uint64_t spread(const std::uint8_t* rgb) {
    return rgb[0] | static_cast<std::uint64_t>(rgb[1]) << kApart | static_cast<std::uint64_t>(rgb[2]) << 2 * kApart;
  }

  std::size_t stride_;
  std::vector<std::uint64_t> pixels_;
};

/// The linear part of the map from a depth pixel to a colour pixel: depth * from_pixel * (u, v, 1) + offset, before division by z.
struct PixelMap {
  Eigen::Matrix3f from_pixel;
  Eigen::Vector3f offset;
};

PixelMap pixel_map(const RgbdCalibration& calibration) {
  const auto matrix = [](const Intrinsics& k) {
    Eigen::Matrix3f m;
    m << k.fx, 0.0F, k.cx, 0.0F, k.fy, k.cy, 0.0F, 0.0F, 1.0F;
    return m;
  };
  const SE3 colour_from_depth = calibration.depth_from_colour.inverse();
  return {matrix(calibration.colour) * colour_from_depth.rotation * matrix(calibration.depth).inverse(),
          matrix(calibration.colour) * colour_from_depth.translation};
}

/// Where the pixels of a row of depth are in the colour image, in steps. u is negative behind the colour camera.
struct RowPositions {
  std::vector<int> u_steps, v_steps;

  void find(const PixelMap& map, const Frame& frame, int v, float default_depth_m) {
    const float* measured_m = &frame.depth(0, v);
    const Eigen::Vector3f x = map.from_pixel.col(0);
    const Eigen::Vector3f row = map.from_pixel.col(1) * static_cast<float>(v) + map.from_pixel.col(2);
    const Eigen::Vector3f offset = map.offset;
    const auto max_u = static_cast<float>(frame.colour.width - 1);
    const auto max_v = static_cast<float>(frame.colour.height - 1);
    for (int u = 0; u < frame.depth.width; ++u) {  // without branches, for the compiler to do many at a time
      const float depth_m = is_valid_depth(measured_m[u]) ? measured_m[u] : default_depth_m;
      const auto along = [&](int axis) { return depth_m * (x[axis] * static_cast<float>(u) + row[axis]) + offset[axis]; };
      const float z = along(2);
      const bool is_ahead = z > 0.0F;
      const float u_px = std::min(std::max(along(0) / z, 0.0F), max_u);
      const float v_px = std::min(std::max(along(1) / z, 0.0F), max_v);
      u_steps[static_cast<std::size_t>(u)] = is_ahead ? static_cast<int>(u_px * kSteps + 0.5F) : -1;
      v_steps[static_cast<std::size_t>(u)] = is_ahead ? static_cast<int>(v_px * kSteps + 0.5F) : 0;
    }
  }
};

/// What is wrong with a frame besides a colour image of another size.
std::string describe_error_but_size(Frame frame) {
  if (frame.colour.empty()) return describe_frame_error(frame);
  frame.colour.width = frame.depth.width;
  frame.colour.height = frame.depth.height;
  return describe_frame_error(frame);
}

}  // namespace

bool is_registered(const RgbdCalibration& calibration) {
  return same_calibration(calibration, {calibration.depth, calibration.depth, SE3{}});
}

bool is_registered(const Frame& frame) {
  return is_registered(frame.calibration) && frame.colour.width == frame.depth.width && frame.colour.height == frame.depth.height;
}

Frame register_colour(const Frame& frame, Image<Rgb8>& registered) {
  FOOTHOLD_EXPECTS_NO_ERROR(describe_error_but_size(frame));
  FOOTHOLD_EXPECTS(frame.depth.memory == MemoryKind::kHost);
  if (is_registered(frame)) return frame;
  const PixelMap map = pixel_map(frame.calibration);
  const float default_depth_m = median_depth_m(frame.depth);
  const SpreadColour colour(frame.colour);  // a copy: the frame may view `registered`
  const auto width = static_cast<std::size_t>(frame.depth.width);
  if (registered.width() != frame.depth.width || registered.height() != frame.depth.height) {
    registered = Image<Rgb8>(frame.depth.width, frame.depth.height);
  }
  RowPositions at{std::vector<int>(width), std::vector<int>(width)};
  for (int v = 0; v < frame.depth.height; ++v) {
    at.find(map, frame, v, default_depth_m);
    Rgb8* row = &registered(0, v);
    for (std::size_t u = 0; u < width; ++u) row[u] = at.u_steps[u] < 0 ? Rgb8{} : colour.at(at.u_steps[u], at.v_steps[u]);
  }
  Frame result = frame;
  result.colour = colour_view(registered);
  result.calibration.colour = frame.calibration.depth;
  result.calibration.depth_from_colour = SE3{};
  return result;
}

void register_colour(RgbdFrame& frame) {
  if (frame.depth.empty()) return;
  frame.calibration = register_colour(frame.view(), frame.colour).calibration;
}

}  // namespace foothold

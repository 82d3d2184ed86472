// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "register_colour.h"

#include <Eigen/LU>
#include <algorithm>
#include <vector>

namespace foothold::io {
namespace {

/// About the median of the valid depths [m], from a sixteenth of them; 2 m, amid the range of depth cameras, if there is none.
float median_depth_m(const Image<float>& depth) {
  constexpr int kStep = 4;
  std::vector<float> valid;
  for (int v = 0; v < depth.height(); v += kStep) {
    for (int u = 0; u < depth.width(); u += kStep) {
      if (is_valid_depth(depth(u, v))) valid.push_back(depth(u, v));
    }
  }
  if (valid.empty()) return 2.0F;
  const auto middle = valid.begin() + static_cast<std::ptrdiff_t>(valid.size() / 2);
  std::nth_element(valid.begin(), middle, valid.end());
  return *middle;
}

/// The colour at a position inside the image, between pixels, in fixed point of 8 bits.
Rgb8 bilinear(const Image<Rgb8>& image, float u, float v) {
  constexpr int kOne = 256;
  const int u_fixed = static_cast<int>(u * kOne + 0.5F);
  const int v_fixed = static_cast<int>(v * kOne + 0.5F);
  const int u0 = u_fixed / kOne;
  const int v0 = v_fixed / kOne;
  const int u1 = std::min(u0 + 1, image.width() - 1);
  const int v1 = std::min(v0 + 1, image.height() - 1);
  const int a = u_fixed % kOne;
  const int b = v_fixed % kOne;
  const Rgb8 p00 = image(u0, v0);
  const Rgb8 p10 = image(u1, v0);
  const Rgb8 p01 = image(u0, v1);
  const Rgb8 p11 = image(u1, v1);
  const auto mix = [&](int c00, int c10, int c01, int c11) {
    const int sum = (kOne - b) * ((kOne - a) * c00 + a * c10) + b * ((kOne - a) * c01 + a * c11);
    return static_cast<std::uint8_t>((sum + kOne * kOne / 2) / (kOne * kOne));
  };
  return {mix(p00.r, p10.r, p01.r, p11.r), mix(p00.g, p10.g, p01.g, p11.g), mix(p00.b, p10.b, p01.b, p11.b)};
}

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

}  // namespace

void register_colour(RgbdFrame& frame) {
  const PixelMap map = pixel_map(frame.calibration);
  const float default_depth_m = median_depth_m(frame.depth);
  const auto max_u = static_cast<float>(frame.colour.width() - 1);
  const auto max_v = static_cast<float>(frame.colour.height() - 1);
  Image<Rgb8> registered(frame.depth.width(), frame.depth.height());
  for (int v = 0; v < registered.height(); ++v) {
    const Eigen::Vector3f row = map.from_pixel.col(1) * static_cast<float>(v) + map.from_pixel.col(2);
    for (int u = 0; u < registered.width(); ++u) {
      const float measured_m = frame.depth(u, v);
      const float depth_m = is_valid_depth(measured_m) ? measured_m : default_depth_m;
      const Eigen::Vector3f point = depth_m * (map.from_pixel.col(0) * static_cast<float>(u) + row) + map.offset;
      if (!(point.z() > 0.0F)) continue;  // behind the colour camera: stays black
      registered(u, v) =
          bilinear(frame.colour, std::clamp(point.x() / point.z(), 0.0F, max_u), std::clamp(point.y() / point.z(), 0.0F, max_v));
    }
  }
  frame.colour = std::move(registered);
  frame.calibration.colour = frame.calibration.depth;
  frame.calibration.depth_from_colour = SE3{};
}

}  // namespace foothold::io

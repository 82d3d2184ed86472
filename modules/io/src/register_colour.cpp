// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "register_colour.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace foothold::io {
namespace {

/// The median of the valid depths [m]; 2 m, amid the range of depth cameras, if there is none.
float median_depth_m(const Image<float>& depth) {
  std::vector<float> valid;
  valid.reserve(depth.size());
  std::copy_if(depth.data(), depth.data() + depth.size(), std::back_inserter(valid), is_valid_depth);
  if (valid.empty()) return 2.0F;
  const auto middle = valid.begin() + static_cast<std::ptrdiff_t>(valid.size() / 2);
  std::nth_element(valid.begin(), middle, valid.end());
  return *middle;
}

/// The colour at a position between pixels, which must lie inside the image.
Rgb8 bilinear(const Image<Rgb8>& image, float u, float v) {
  const int u0 = std::min(static_cast<int>(u), std::max(0, image.width() - 2));
  const int v0 = std::min(static_cast<int>(v), std::max(0, image.height() - 2));
  const int u1 = std::min(u0 + 1, image.width() - 1);
  const int v1 = std::min(v0 + 1, image.height() - 1);
  const float a = u - static_cast<float>(u0);
  const float b = v - static_cast<float>(v0);
  const Rgb8 p00 = image(u0, v0);
  const Rgb8 p10 = image(u1, v0);
  const Rgb8 p01 = image(u0, v1);
  const Rgb8 p11 = image(u1, v1);
  const auto mix = [&](std::uint8_t c00, std::uint8_t c10, std::uint8_t c01, std::uint8_t c11) {
    const float top = (1.0F - a) * static_cast<float>(c00) + a * static_cast<float>(c10);
    const float bottom = (1.0F - a) * static_cast<float>(c01) + a * static_cast<float>(c11);
    return static_cast<std::uint8_t>((1.0F - b) * top + b * bottom + 0.5F);
  };
  return {mix(p00.r, p10.r, p01.r, p11.r), mix(p00.g, p10.g, p01.g, p11.g), mix(p00.b, p10.b, p01.b, p11.b)};
}

}  // namespace

void register_colour(RgbdFrame& frame) {
  const RgbdCalibration& calibration = frame.calibration;
  const SE3 colour_from_depth = calibration.depth_from_colour.inverse();
  const float default_depth_m = median_depth_m(frame.depth);
  const auto max_u = static_cast<float>(frame.colour.width() - 1);
  const auto max_v = static_cast<float>(frame.colour.height() - 1);
  Image<Rgb8> registered(frame.depth.width(), frame.depth.height());
  for (int v = 0; v < registered.height(); ++v) {
    for (int u = 0; u < registered.width(); ++u) {
      const float measured_m = frame.depth(u, v);
      const float depth_m = is_valid_depth(measured_m) ? measured_m : default_depth_m;
      const Eigen::Vector3f point_colour =
          colour_from_depth * calibration.depth.back_project(static_cast<float>(u), static_cast<float>(v), depth_m);
      if (!(point_colour.z() > 0.0F)) continue;  // behind the colour camera: stays black
      const Eigen::Vector2f pixel = calibration.colour.project(point_colour);
      registered(u, v) = bilinear(frame.colour, std::clamp(pixel.x(), 0.0F, max_u), std::clamp(pixel.y(), 0.0F, max_v));
    }
  }
  frame.colour = std::move(registered);
  frame.calibration.colour = frame.calibration.depth;
  frame.calibration.depth_from_colour = SE3{};
}

}  // namespace foothold::io

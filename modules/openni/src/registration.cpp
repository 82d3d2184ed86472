// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "registration.h"

#include <algorithm>
#include <cmath>

namespace foothold::capture {
namespace {

constexpr float kHalfSquare = 0.55F;  ///< slightly more than half a pixel, so that rounding and slanted surfaces open no gaps
constexpr float kMaxSquare_px =
    8.0F;  ///< a measurement nearer than the focal lengths' ratio explains is noise; it must not cover the image

/// The pixel centres in [low, high), clipped to the image.
struct PixelRange {
  PixelRange(float low, float high, int size)
      : begin(std::max(0, static_cast<int>(std::ceil(std::max(low, -1.0F))))),
        end(std::min(size, static_cast<int>(std::ceil(std::min(high, static_cast<float>(size)))))) {}
  int begin;
  int end;
};

}  // namespace

void register_depth_to_colour(const Image<float>& depth, const RgbdCalibration& calibration, Image<float>& registered) {
  registered = Image<float>(depth.width(), depth.height(), 0.0F);
  const SE3 colour_from_depth = calibration.depth_from_colour.inverse();
  for (int v = 0; v < depth.height(); ++v) {
    for (int u = 0; u < depth.width(); ++u) {
      if (!is_valid_depth(depth(u, v))) continue;
      const Eigen::Vector3f point_depth = calibration.depth.back_project(static_cast<float>(u), static_cast<float>(v), depth(u, v));
      const Eigen::Vector3f point_colour = colour_from_depth * point_depth;
      if (point_colour.z() <= 0.0F) continue;
      const Eigen::Vector2f pixel = calibration.colour.project(point_colour);
      const float scale = depth(u, v) / point_colour.z();
      const float half_u = kHalfSquare * std::min(kMaxSquare_px, scale * calibration.colour.fx / calibration.depth.fx);
      const float half_v = kHalfSquare * std::min(kMaxSquare_px, scale * calibration.colour.fy / calibration.depth.fy);
      const PixelRange columns(pixel.x() - half_u, pixel.x() + half_u, depth.width());
      const PixelRange rows(pixel.y() - half_v, pixel.y() + half_v, depth.height());
      for (int y = rows.begin; y < rows.end; ++y) {
        for (int x = columns.begin; x < columns.end; ++x) {
          float& z = registered(x, y);
          if (z == 0.0F || point_colour.z() < z) z = point_colour.z();
        }
      }
    }
  }
}

}  // namespace foothold::capture

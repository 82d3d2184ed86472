// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// Grey values of a frame where its depth camera measured.
#pragma once

#include "foothold/api/frame.h"
#include "rounding.h"

namespace foothold {

/// Grey of a colour, in [0, 1], by the luma weights of ITU-R BT.601.
FOOTHOLD_HD inline float grey_of(const Rgb8& colour) {
  return (0.299F * static_cast<float>(colour.r) + 0.587F * static_cast<float>(colour.g) + 0.114F * static_cast<float>(colour.b)) *
         (1.0F / 255.0F);
}

/// Looks up the grey of points of the depth camera in the colour image.
struct GreySampler {
  /// Side of the squares that are averaged [px]: renderings are smooth, and single pixels would alias.
  static constexpr int kSide = 4;

  ColourView colour;
  Intrinsics intrinsics;  ///< of the colour camera
  SE3 colour_from_depth;

  static GreySampler of(const Frame& frame) {
    return {frame.colour, frame.calibration.colour, frame.calibration.depth_from_colour.inverse()};
  }

  /// Grey in [0, 1], or -1 where the colour camera does not see the point.
  FOOTHOLD_HD float at(const Eigen::Vector3f& point_depth) const {
    const Eigen::Vector3f point = colour_from_depth * point_depth;
    if (point.z() <= 0.0F) return -1.0F;
    int cu = 0;
    int cv = 0;
    if (!nearest_pixel(intrinsics.project(point), colour.width, colour.height, cu, cv)) return -1.0F;
    float sum = 0.0F;
    const int u0 = cu - kSide / 2;
    const int v0 = cv - kSide / 2;
    if (u0 >= 0 && v0 >= 0 && u0 + kSide <= colour.width && v0 + kSide <= colour.height) {
      for (int y = 0; y < kSide; ++y) {
        float greys[kSide];
        for (int x = 0; x < kSide; ++x) greys[x] = grey_of(colour(u0 + x, v0 + y));
        for (const float grey : greys) sum += grey;
      }
      return sum / static_cast<float>(kSide * kSide);
    }
    int count = 0;
    for (int y = cv - kSide / 2; y <= cv + (kSide - 1) / 2; ++y) {
      for (int x = cu - kSide / 2; x <= cu + (kSide - 1) / 2; ++x) {
        if (x < 0 || y < 0 || x >= colour.width || y >= colour.height) continue;
        sum += grey_of(colour(x, y));
        ++count;
      }
    }
    return sum / static_cast<float>(count);
  }
};

}  // namespace foothold

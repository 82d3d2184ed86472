// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// Halving a depth image, and counting its pixels with depth.
#pragma once

#include <cstdint>

#include "foothold/base/image.h"
#include "foothold/fusion/tsdf_volume.h"

namespace foothold {

/// Averages the depths of 2 x 2 pixels that lie on the nearest one's surface.
struct HalveDepth {
  ImageView<const float> fine;
  DepthRange range;
  float* coarse;
  int coarse_width;

  FOOTHOLD_HD void operator()(std::size_t i) const {
    constexpr float kSameSurface = 0.03F;  // of the depth
    const int u = static_cast<int>(i) % coarse_width * 2;
    const int v = static_cast<int>(i) / coarse_width * 2;
    const float depths_m[4] = {fine(u, v), fine(u + 1, v), fine(u, v + 1), fine(u + 1, v + 1)};
    float nearest_m = range.max_m + 1.0F;
    for (const float depth_m : depths_m) nearest_m = depth_m >= range.min_m && depth_m < nearest_m ? depth_m : nearest_m;
    float sum = 0.0F;
    float count = 0.0F;
    for (const float depth_m : depths_m) {
      const bool same = depth_m >= nearest_m && depth_m <= nearest_m * (1.0F + kSameSurface);
      sum += same ? depth_m : 0.0F;
      count += same ? 1.0F : 0.0F;
    }
    coarse[i] = nearest_m <= range.max_m ? sum / count : 0.0F;
  }
};

/// Counts the pixels of one row whose depth is in range.
struct CountRow {
  ImageView<const float> depth;
  DepthRange range;
  std::uint32_t* counts;

  FOOTHOLD_HD void operator()(std::size_t row) const {
    std::uint32_t count = 0;
    for (int u = 0; u < depth.width; ++u) {
      count += range.holds(depth(u, static_cast<int>(row))) ? 1 : 0;
    }
    counts[row] = count;
  }
};

}  // namespace foothold

// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// Halving a depth image, making a surface of it, and counting its pixels with depth.
#pragma once

#include <Eigen/Geometry>
#include <cmath>
#include <cstdint>

#include "icp/icp_state.h"

namespace foothold {

/// Averages the depths of 2 x 2 pixels that lie on the nearest one's surface, for one row.
struct HalveDepth {
  ImageView<const float> fine;
  DepthRange range;
  float* coarse;
  int coarse_width;

  template <class Team>
  FOOTHOLD_HD void operator()(const Team& team, std::size_t row) const {
    const std::size_t fine_width = static_cast<std::size_t>(fine.width);
    const float* const upper = fine.data + 2 * row * fine_width;
    const float* const lower = upper + fine_width;
    float* const halved = coarse + row * static_cast<std::size_t>(coarse_width);
    for (int u = team.lane(); u < coarse_width; u += team.size()) {
      halved[u] = mean_of_nearest(upper[2 * u], upper[2 * u + 1], lower[2 * u], lower[2 * u + 1]);
    }
  }

 private:
  FOOTHOLD_HD float mean_of_nearest(float a_m, float b_m, float c_m, float d_m) const {
    constexpr float kSameSurface = 0.03F;  // of the depth
    const float depths_m[4] = {a_m, b_m, c_m, d_m};
    float nearest_m = range.max_m + 1.0F;
    for (const float depth_m : depths_m) nearest_m = (depth_m >= range.min_m) & (depth_m < nearest_m) ? depth_m : nearest_m;
    float sum = 0.0F;
    float count = 0.0F;
    for (const float depth_m : depths_m) {
      const bool same = (depth_m >= nearest_m) & (depth_m <= nearest_m * (1.0F + kSameSurface));
      sum += same ? depth_m : 0.0F;
      count += same ? 1.0F : 0.0F;
    }
    return nearest_m <= range.max_m ? sum / count : 0.0F;
  }
};

/// Makes a rendering of a frame: its own depth with the normals of neighbouring pixels.
struct MakeSurfacePixel {
  DepthLevel level;
  DepthRange range;
  SurfacePixel* surface;

  FOOTHOLD_HD void operator()(std::size_t i) const {
    const int u = static_cast<int>(i) % level.depth.width;
    const int v = static_cast<int>(i) / level.depth.width;
    SurfacePixel pixel;
    const float depth_m = level.depth(u, v);
    pixel.depth_m = range.holds(depth_m) ? depth_m : 0.0F;
    const bool inside = u > 0 && v > 0 && u < level.depth.width - 1 && v < level.depth.height - 1;
    if (inside && pixel.depth_m > 0.0F) {
      constexpr float kSameSurface = 0.05F;  // of the depth
      const float depths_m[4] = {level.depth(u - 1, v), level.depth(u + 1, v), level.depth(u, v - 1), level.depth(u, v + 1)};
      bool is_smooth = true;
      for (const float neighbour_m : depths_m) is_smooth &= std::abs(neighbour_m - depth_m) < kSameSurface * depth_m;
      const auto x = static_cast<float>(u);
      const auto y = static_cast<float>(v);
      const Eigen::Vector3f along_u =
          level.intrinsics.back_project(x + 1.0F, y, depths_m[1]) - level.intrinsics.back_project(x - 1.0F, y, depths_m[0]);
      const Eigen::Vector3f along_v =
          level.intrinsics.back_project(x, y + 1.0F, depths_m[3]) - level.intrinsics.back_project(x, y - 1.0F, depths_m[2]);
      const Eigen::Vector3f across = along_v.cross(along_u);
      const float length = across.norm();
      if (is_smooth && length > 0.0F) {
        const Eigen::Vector3f normal = across / length;
        pixel.normal_x = normal.x();
        pixel.normal_y = normal.y();
        pixel.normal_z = normal.z();
      }
    }
    surface[i] = pixel;
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

// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// Grey values for alignment: of the live image by level, and of a rendering with their gradient.
#pragma once

#include <cmath>

#include "grey_sampler.h"
#include "icp/icp_state.h"

namespace foothold {

/// Samples the grey of one pixel with depth of a level; -1 where there is none.
struct SampleGrey {
  DepthLevel level;
  DepthRange range;
  GreySampler sampler;
  float* greys;

  FOOTHOLD_HD void operator()(std::size_t i) const {
    const int u = static_cast<int>(i) % level.depth.width;
    const int v = static_cast<int>(i) / level.depth.width;
    const float depth_m = level.depth(u, v);
    greys[i] =
        range.holds(depth_m) ? sampler.at(level.intrinsics.back_project(static_cast<float>(u), static_cast<float>(v), depth_m)) : -1.0F;
  }
};

/// Smooths greys by the binomial filter 1 2 1, over what is known around a pixel.
struct SmoothGrey {
  const float* sharp;
  int width;
  int height;
  float* greys;

  FOOTHOLD_HD void operator()(std::size_t i) const {
    const int u = static_cast<int>(i) % width;
    const int v = static_cast<int>(i) / width;
    float sum = 0.0F;
    float total = 0.0F;
    for (int y = v > 0 ? v - 1 : v; y <= (v < height - 1 ? v + 1 : v); ++y) {
      for (int x = u > 0 ? u - 1 : u; x <= (u < width - 1 ? u + 1 : u); ++x) {
        const float grey = sharp[y * width + x];
        const float weight = (y == v ? 2.0F : 1.0F) * (x == u ? 2.0F : 1.0F);
        sum += grey >= 0.0F ? weight * grey : 0.0F;
        total += grey >= 0.0F ? weight : 0.0F;
      }
    }
    greys[i] = sharp[i] >= 0.0F ? sum / total : -1.0F;
  }
};

/// Averages what is known of the greys of 2 x 2 pixels.
struct HalveGrey {
  const float* fine;
  int fine_width;
  int width;
  float* coarse;

  FOOTHOLD_HD void operator()(std::size_t i) const {
    const int u = 2 * (static_cast<int>(i) % width);
    const int v = 2 * (static_cast<int>(i) / width);
    const float* const upper = fine + static_cast<std::size_t>(v) * static_cast<std::size_t>(fine_width) + u;
    const float greys[4] = {upper[0], upper[1], upper[fine_width], upper[fine_width + 1]};
    float sum = 0.0F;
    float count = 0.0F;
    for (const float grey : greys) {
      sum += grey >= 0.0F ? grey : 0.0F;
      count += grey >= 0.0F ? 1.0F : 0.0F;
    }
    coarse[i] = count > 0.0F ? sum / count : -1.0F;
  }
};

/// Makes one pixel of a rendering's grey image.
struct MakeGreyPixel {
  const SurfacePixel* surfaces;  ///< one rendering after another
  const Rgb8* colours;
  int width;
  int height;
  GreyPixel* greys;

  FOOTHOLD_HD void operator()(std::size_t i) const {
    constexpr float kSameSurface = 0.05F;  // of the depth
    const int u = static_cast<int>(i) % width;
    const int v = static_cast<int>(i) / width % height;
    GreyPixel pixel;
    const float depth_m = surfaces[i].depth_m;
    if (u > 0 && v > 0 && u < width - 1 && v < height - 1 && depth_m > 0.0F) {
      bool is_smooth = true;
      float rows[3][3];
      for (int dv = 0; dv < 3; ++dv) {
        for (int du = 0; du < 3; ++du) {
          const std::size_t j = i + static_cast<std::size_t>(dv * width + du) - static_cast<std::size_t>(width + 1);
          is_smooth &= std::abs(surfaces[j].depth_m - depth_m) < kSameSurface * depth_m && is_coloured(j);
          rows[dv][du] = grey_of(colours[j]);
        }
      }
      if (is_smooth) {
        const auto across = [&](int row) { return 0.25F * (rows[row][0] + 2.0F * rows[row][1] + rows[row][2]); };
        const auto along = [&](int row) { return 0.5F * (rows[row][2] - rows[row][0]); };
        pixel.grey = 0.25F * (across(0) + 2.0F * across(1) + across(2));
        pixel.along_u = 0.25F * (along(0) + 2.0F * along(1) + along(2));
        pixel.along_v = 0.5F * (across(2) - across(0));
      }
    }
    greys[i] = pixel;
  }

 private:
  FOOTHOLD_HD bool is_coloured(std::size_t i) const { return (colours[i].r | colours[i].g | colours[i].b) != 0; }
};

}  // namespace foothold

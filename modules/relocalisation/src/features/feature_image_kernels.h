// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// Packing a feature image, for both devices.
#pragma once

#include "foothold/relocalisation/feature_image.h"

namespace foothold {

/// Averages one block of the frame. Sums are integers, so that the result is the same on every device.
struct PackFeaturePixel {
  ImageView<const float> depth;
  ColourView colour;
  int downscale;
  int width;
  FeaturePixel* pixels;

  FOOTHOLD_HD void operator()(std::size_t i) const {
    const int u0 = static_cast<int>(i) % width * downscale;
    const int v0 = static_cast<int>(i) / width * downscale;
    int depth_sum_mm = 0;
    int num_depths = 0;
    int r = 0;
    int g = 0;
    int b = 0;
    for (int v = v0; v < v0 + downscale; ++v) {
      for (int u = u0; u < u0 + downscale; ++u) {
        const float depth_m = depth(u, v);
        if (depth_m > 0.0F && depth_m < kMaxDepthM) {
          depth_sum_mm += static_cast<int>(depth_m * 1000.0F + 0.5F);
          ++num_depths;
        }
        const Rgb8 rgb = colour(u, v);
        r += rgb.r;
        g += rgb.g;
        b += rgb.b;
      }
    }
    const int num_pixels = downscale * downscale;
    FeaturePixel pixel;
    pixel.channels[0] = static_cast<std::int16_t>(num_depths > 0 ? (depth_sum_mm + num_depths / 2) / num_depths : 0);
    pixel.channels[1] = static_cast<std::int16_t>((r + num_pixels / 2) / num_pixels);
    pixel.channels[2] = static_cast<std::int16_t>((g + num_pixels / 2) / num_pixels);
    pixel.channels[3] = static_cast<std::int16_t>((b + num_pixels / 2) / num_pixels);
    pixels[i] = pixel;
  }

  static constexpr float kMaxDepthM = 32.0F;  ///< what 16 bits of millimetres hold
};

template <class Executor>
struct FeatureImageAlgorithms {
  static void pack(const Context& context, const Frame& frame, int downscale, const FeatureImageView& view, FeaturePixel* pixels);
};

template <class Executor>
void FeatureImageAlgorithms<Executor>::pack(const Context& context, const Frame& frame, int downscale, const FeatureImageView& view,
                                            FeaturePixel* pixels) {
  Executor(context).for_each(static_cast<std::size_t>(view.width) * static_cast<std::size_t>(view.height),
                             PackFeaturePixel{frame.depth, frame.colour, downscale, view.width, pixels});
}

}  // namespace foothold

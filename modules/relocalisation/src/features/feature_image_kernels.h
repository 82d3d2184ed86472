// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// The bodies of feature_image.h, for both devices.
#pragma once

#include <cmath>

#include "features/feature_image.h"

namespace foothold {

/// Averages one block of the frame. Sums are integers, so that the result is the same on every device.
struct PackFeaturePixel {
  ImageView<const float> depth;
  ColourView colour;
  int downscale;
  int width;
  FeaturePixel* pixels;

  FOOTHOLD_HD void operator()(std::size_t i) const {
    const int u0 = static_cast<int>(i % static_cast<std::size_t>(width)) * downscale;
    const int v0 = static_cast<int>(i / static_cast<std::size_t>(width)) * downscale;
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
    pixel.depth_mm = static_cast<std::int16_t>(num_depths > 0 ? (depth_sum_mm + num_depths / 2) / num_depths : 0);
    pixel.r = static_cast<std::int16_t>((r + num_pixels / 2) / num_pixels);
    pixel.g = static_cast<std::int16_t>((g + num_pixels / 2) / num_pixels);
    pixel.b = static_cast<std::int16_t>((b + num_pixels / 2) / num_pixels);
    pixels[i] = pixel;
  }

  static constexpr float kMaxDepthM = 32.0F;  ///< what 16 bits of millimetres hold
};

FOOTHOLD_HD inline int clamp_index(int i, int size) { return i < 0 ? 0 : (i >= size ? size - 1 : i); }

FOOTHOLD_HD inline int channel_value(const FeaturePixel& pixel, FeatureChannel channel) {
  switch (channel) {
    case FeatureChannel::kDepth:
      return pixel.depth_mm;
    case FeatureChannel::kRed:
      return pixel.r;
    case FeatureChannel::kGreen:
      return pixel.g;
    default:
      return pixel.b;
  }
}

/// Eq. 1 and 2: the difference of a channel between a pixel and its partner, which is clamped to the image.
FOOTHOLD_HD inline int evaluate_feature(const FeatureImageView& image, int u, int v, const FeaturePixel& centre, float px_per_offset,
                                        const ForestFeature& feature) {
  const int partner_u = clamp_index(u + static_cast<int>(std::floor(feature.offset_u_px_m * px_per_offset + 0.5F)), image.width);
  const int partner_v = clamp_index(v + static_cast<int>(std::floor(feature.offset_v_px_m * px_per_offset + 0.5F)), image.height);
  const FeaturePixel& partner = image.pixels[partner_v * image.width + partner_u];
  return channel_value(centre, feature.channel) - channel_value(partner, feature.channel);
}

/// Walks one pixel down one tree; evaluates only the features on its way.
struct FindLeaf {
  FeatureImageView image;
  int downscale;
  ForestView forest;
  Span<const SampledPixel> pixels;
  std::uint32_t* leaves;

  FOOTHOLD_HD void operator()(std::size_t i) const {
    const std::size_t tree = i / pixels.size();
    const SampledPixel pixel = pixels[i % pixels.size()];
    const int u = clamp_index(pixel.u / downscale, image.width);
    const int v = clamp_index(pixel.v / downscale, image.height);
    const FeaturePixel centre = image.pixels[v * image.width + u];
    if (pixel.depth_m <= 0.0F || centre.depth_mm <= 0) {
      leaves[i] = static_cast<std::uint32_t>(forest.num_leaves);
      return;
    }
    const float px_per_offset = image.offset_scale_px_mm / static_cast<float>(centre.depth_mm);
    ForestNode node = forest.nodes[forest.roots[tree]];
    while (node.left_child >= 0) {
      const int value = evaluate_feature(image, u, v, centre, px_per_offset, forest.features[node.feature]);
      node = forest.nodes[node.left_child + (value >= node.threshold ? 1 : 0)];
    }
    leaves[i] = static_cast<std::uint32_t>(~node.left_child);
  }
};

template <class Executor>
struct FeatureAlgorithms {
  static void pack(const Context& context, const Frame& frame, int downscale, const FeatureImageView& view, FeaturePixel* pixels);
  static void find_leaves(const Context& context, const FeatureImageView& image, int downscale, const ForestView& forest,
                          Span<const SampledPixel> pixels, Span<std::uint32_t> leaves);
};

template <class Executor>
void FeatureAlgorithms<Executor>::pack(const Context& context, const Frame& frame, int downscale, const FeatureImageView& view,
                                       FeaturePixel* pixels) {
  Executor(context).for_each(static_cast<std::size_t>(view.width) * static_cast<std::size_t>(view.height),
                             PackFeaturePixel{frame.depth, frame.colour, downscale, view.width, pixels});
}

template <class Executor>
void FeatureAlgorithms<Executor>::find_leaves(const Context& context, const FeatureImageView& image, int downscale,
                                              const ForestView& forest, Span<const SampledPixel> pixels, Span<std::uint32_t> leaves) {
  Executor(context).for_each(pixels.size() * static_cast<std::size_t>(forest.num_trees),
                             FindLeaf{image, downscale, forest, pixels, leaves.data()});
}

}  // namespace foothold

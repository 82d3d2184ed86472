// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// Packing a feature image, for both devices.
#pragma once

#include "foothold/relocalisation/feature_image.h"

namespace foothold {

/// Averages a few adjacent blocks of the frame. Sums are integers, so that the result is the same on every device, in whatever order.
template <int kWidth>
struct PackFeaturePixels {
  ImageView<const float> depth;
  ColourView colour;
  int downscale;
  int width;  ///< of the averaged image
  int groups_per_row;
  FeaturePixel* pixels;

  FOOTHOLD_HD void operator()(std::size_t i) const {
    const int v = static_cast<int>(i) / groups_per_row;
    const int first = static_cast<int>(i) % groups_per_row * kWidth;
    const int num = width - first < kWidth ? width - first : kWidth;
    BlockSums sums[kWidth] = {};
    if (kWidth > 1 && downscale <= kWidestBlock) {
      sum_columns(first, num, v, sums);
    } else {
      for (int w = 0; w < num; ++w) sum_block(first + w, v, sums[w]);
    }
    for (int w = 0; w < num; ++w) pixels[v * width + first + w] = mean_of(sums[w]);
  }

 private:
  static constexpr float kMaxDepthM = 32.0F;  ///< what 16 bits of millimetres hold
  static constexpr int kWidestBlock = 8;      ///< whose columns are summed side by side
  static constexpr int kMaxColumns = kWidth * kWidestBlock;

  struct BlockSums {
    int depth_mm;
    int num_depths;
    int rgb[3];
  };

  FOOTHOLD_HD static bool has_depth(float depth_m) { return (depth_m > 0.0F) & (depth_m < kMaxDepthM); }
  FOOTHOLD_HD static int in_millimetres(float depth_m) { return static_cast<int>(depth_m * 1000.0F + 0.5F); }

  FOOTHOLD_HD void sum_block(int block_u, int block_v, BlockSums& sums) const {
    for (int v = block_v * downscale; v < (block_v + 1) * downscale; ++v) {
      for (int u = block_u * downscale; u < (block_u + 1) * downscale; ++u) {
        const float depth_m = depth(u, v);
        if (has_depth(depth_m)) {
          sums.depth_mm += in_millimetres(depth_m);
          ++sums.num_depths;
        }
        const Rgb8 rgb = colour(u, v);
        sums.rgb[0] += rgb.r;
        sums.rgb[1] += rgb.g;
        sums.rgb[2] += rgb.b;
      }
    }
  }

  /// Sums up the columns first, a vector of them at a time, then those of each block.
  FOOTHOLD_HD void sum_columns(int first_block, int num_blocks, int block_v, BlockSums* sums) const {
    const int num_columns = num_blocks * downscale;
    const int num_bytes = num_columns * colour.bytes_per_pixel;
    std::int32_t depths_mm[kMaxColumns] = {};
    std::int32_t num_depths[kMaxColumns] = {};
    std::uint16_t bytes[kMaxColumns * 4] = {};
    for (int v = block_v * downscale; v < (block_v + 1) * downscale; ++v) {
      const float* const depth_row = &depth(first_block * downscale, v);
      for (int u = 0; u < num_columns; ++u) {
        const bool is_valid = has_depth(depth_row[u]);
        depths_mm[u] += in_millimetres(is_valid ? depth_row[u] : 0.0F);
        num_depths[u] += is_valid ? 1 : 0;
      }
      const std::uint8_t* const colour_row = colour.data + (static_cast<std::size_t>(v) * static_cast<std::size_t>(colour.width) +
                                                            static_cast<std::size_t>(first_block * downscale)) *
                                                               static_cast<std::size_t>(colour.bytes_per_pixel);
      for (int i = 0; i < num_bytes; ++i) bytes[i] = static_cast<std::uint16_t>(bytes[i] + colour_row[i]);
    }
    for (int w = 0, u = 0; w < num_blocks; ++w) {
      for (const int end = u + downscale; u < end; ++u) {
        sums[w].depth_mm += depths_mm[u];
        sums[w].num_depths += num_depths[u];
        for (int k = 0; k < 3; ++k) sums[w].rgb[k] += bytes[u * colour.bytes_per_pixel + k];
      }
    }
  }

  FOOTHOLD_HD FeaturePixel mean_of(const BlockSums& sums) const {
    const int num_pixels = downscale * downscale;
    FeaturePixel pixel;
    pixel.channels[0] = static_cast<std::int16_t>(sums.num_depths > 0 ? (sums.depth_mm + sums.num_depths / 2) / sums.num_depths : 0);
    for (int k = 0; k < 3; ++k) pixel.channels[k + 1] = static_cast<std::int16_t>((sums.rgb[k] + num_pixels / 2) / num_pixels);
    return pixel;
  }
};

/// Multiplies a pixel's colours.
struct RelightPixel {
  const FeaturePixel* from;
  float gain;
  FeaturePixel* to;

  FOOTHOLD_HD void operator()(std::size_t i) const {
    FeaturePixel pixel = from[i];
    for (int k = 1; k < 4; ++k) {
      const int relit = static_cast<int>(gain * static_cast<float>(pixel.channels[k]) + 0.5F);
      pixel.channels[k] = static_cast<std::int16_t>(relit < 255 ? relit : 255);
    }
    to[i] = pixel;
  }
};

template <class Executor>
struct FeatureImageAlgorithms {
  static void pack(const Context& context, const Frame& frame, int downscale, const FeatureImageView& view, FeaturePixel* pixels);
  static void relight(const Context& context, const RelightPixel& body, std::size_t num_pixels);
};

template <class Executor>
void FeatureImageAlgorithms<Executor>::pack(const Context& context, const Frame& frame, int downscale, const FeatureImageView& view,
                                            FeaturePixel* pixels) {
  constexpr int kWidth = Executor::kVectorWidth;
  const int groups_per_row = (view.width + kWidth - 1) / kWidth;
  Executor(context).for_each(static_cast<std::size_t>(groups_per_row) * static_cast<std::size_t>(view.height),
                             PackFeaturePixels<kWidth>{frame.depth, frame.colour, downscale, view.width, groups_per_row, pixels});
}

template <class Executor>
void FeatureImageAlgorithms<Executor>::relight(const Context& context, const RelightPixel& body, std::size_t num_pixels) {
  Executor(context).for_each(num_pixels, body);
}

}  // namespace foothold

// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// Sampling and filling the pool of pool.h, for both devices.
#pragma once

#include "foothold/base/exec/prefetch.h"
#include "foothold/base/random.h"
#include "pose/pool.h"
#include "pose/pose_query.h"

namespace foothold {

/// Places sample i of a low-discrepancy sequence, whose every prefix covers the image evenly; moves on where there is no depth.
struct SamplePoolPixel {
  ImageView<const float> depth;
  float shift_u;
  float shift_v;
  std::uint32_t pool_size;
  SampledPixel* sampled;

  FOOTHOLD_HD void operator()(std::size_t i) const {
    constexpr int kTries = 8;
    // The R2 sequence [Roberts2018] in 32-bit fixed point: multiples of 1/phi and 1/phi^2, with phi^3 = phi + 1.
    constexpr std::uint32_t kStepU = 3242174889U;
    constexpr std::uint32_t kStepV = 2447445414U;
    for (int k = 0; k < kTries; ++k) {
      const auto n = static_cast<std::uint32_t>(i) + static_cast<std::uint32_t>(k) * pool_size + 1U;
      const std::uint32_t fixed_u = n * kStepU + static_cast<std::uint32_t>(shift_u * 4294967040.0F);
      const std::uint32_t fixed_v = n * kStepV + static_cast<std::uint32_t>(shift_v * 4294967040.0F);
      const auto u = static_cast<int>((static_cast<std::uint64_t>(fixed_u) * static_cast<std::uint64_t>(depth.width)) >> 32U);
      const auto v = static_cast<int>((static_cast<std::uint64_t>(fixed_v) * static_cast<std::uint64_t>(depth.height)) >> 32U);
      const float depth_m = depth(u, v);
      if (!is_valid_depth(depth_m)) continue;
      sampled[i] = {static_cast<std::int16_t>(u), static_cast<std::int16_t>(v), depth_m};
      return;
    }
    sampled[i] = {};
  }
};

/// Counts the modes of the leaves that a sampled pixel reaches.
struct CountModes {
  LeafModesView leaf_modes;
  int num_trees;
  std::uint32_t num_leaves;
  PoolPart part;
  std::uint32_t* mode_counts;
  std::uint32_t* has_modes;

  FOOTHOLD_HD void operator()(std::size_t index) const {
    const std::size_t i = part.first + index;
    std::uint32_t count = 0;
    for (int tree = 0; tree < num_trees; ++tree) {
      const std::uint32_t leaf = part.leaf(i, tree);
      if (leaf < num_leaves) count += leaf_modes.num_modes[leaf];
    }
    mode_counts[i] = count;
    has_modes[i] = count > 0 ? 1 : 0;
  }
};

/// Packs the pixels that have modes, with their modes behind one another. A few are packed after each other, whose modes are fetched
/// together.
template <int kWidth>
struct GatherPixels {
  Intrinsics intrinsics;
  FeatureImageView image;
  int downscale;
  LeafModesView leaf_modes;
  int num_trees;
  std::uint32_t num_leaves;
  PoolPart part;
  const SampledPixel* sampled;
  const std::uint32_t* mode_counts;
  const std::uint32_t* first_modes;
  const std::uint32_t* slots;
  PooledPixel* pixels;
  Mode* modes;

  FOOTHOLD_HD void operator()(std::size_t group) const {
    const std::size_t first = part.first + group * static_cast<std::size_t>(kWidth);
    const std::size_t end = first + kWidth < part.first + part.size ? first + kWidth : part.first + part.size;
    if constexpr (kWidth > 1) {
      for (std::size_t i = first; i < end; ++i) for_each_mode(i, [](const Mode& mode) { prefetch(&mode); });
    }
    for (std::size_t i = first; i < end; ++i) {
      if (mode_counts[i] > 0) gather(i);
    }
  }

 private:
  template <class Visit>
  FOOTHOLD_HD FOOTHOLD_INLINE void for_each_mode(std::size_t i, const Visit& visit) const {
    for (int tree = 0; tree < num_trees; ++tree) {
      const std::uint32_t leaf = part.leaf(i, tree);
      if (leaf >= num_leaves) continue;
      const std::uint32_t num_modes = leaf_modes.num_modes[leaf];
      for (std::uint32_t k = 0; k < num_modes; ++k) visit(leaf_modes.modes.at(leaf, static_cast<int>(k)));
    }
  }

  FOOTHOLD_HD void gather(std::size_t i) const {
    const SampledPixel& at = sampled[i];
    const Eigen::Vector3f point = intrinsics.back_project(at.u, at.v, at.depth_m);
    const FeaturePixel& colour =
        image.pixels[clamp_index(at.v / downscale, image.height) * image.width + clamp_index(at.u / downscale, image.width)];
    PooledPixel pixel;
    for (int k = 0; k < 3; ++k) pixel.point_camera[k] = point[k];
    pixel.first_mode = first_modes[i];
    pixel.num_modes = static_cast<std::uint16_t>(mode_counts[i]);
    pixel.rgb[0] = static_cast<std::uint8_t>(colour.r());
    pixel.rgb[1] = static_cast<std::uint8_t>(colour.g());
    pixel.rgb[2] = static_cast<std::uint8_t>(colour.b());
    pixel.reserved = 0;
    pixels[slots[i]] = pixel;
    Mode* next = modes + first_modes[i];
    for_each_mode(i, [&](const Mode& mode) { *next++ = mode; });
  }
};

/// Chooses the pixels that the pool is filled from.
template <class Executor>
void sample_pool(const Executor& executor, const PoseQuery& query, std::uint64_t seed, CorrespondencePool& pool) {
  constexpr std::uint64_t kStream = ~std::uint64_t{0};
  Random random(seed, kStream);
  const float shift_u = random.uniform();
  executor.for_each(pool.sampled.size(), SamplePoolPixel{query.frame.depth, shift_u, random.uniform(),
                                                         static_cast<std::uint32_t>(pool.sampled.size()), pool.sampled.data()});
}

/// Fills the pool with those of the next sampled pixels, up to `num_samples` in all, that reach leaves with modes.
template <class Executor>
void fill_pool(const Context& context, const PoseQuery& query, const LeafModesView& leaf_modes, const ForestView& forest,
               std::size_t num_samples, CorrespondencePool& pool) {
  const Executor executor(context);
  const auto num_leaves = static_cast<std::uint32_t>(forest.num_leaves);
  const std::size_t num_new = num_samples - pool.num_filled;
  const auto num_trees = static_cast<std::size_t>(forest.num_trees);
  const Span<std::uint32_t> leaves(pool.leaves.data() + pool.num_filled * num_trees, num_new * num_trees);
  const PoolPart part{pool.num_filled, num_new, leaves.data()};
  if (part.first == 0) pool.first_part = part;
  find_leaves(context, query.image, forest, Span<const SampledPixel>(pool.sampled.data() + part.first, num_new), leaves);
  executor.for_each(num_new, CountModes{leaf_modes, forest.num_trees, num_leaves, part, pool.mode_counts.data(), pool.has_modes.data()});
  const auto scan = [&](const Array<std::uint32_t>& counts, Array<std::uint32_t>& sums) {
    executor.exclusive_scan(Span<const std::uint32_t>(counts.data(), num_samples), Span<std::uint32_t>(sums.data(), num_samples + 1));
  };
  scan(pool.mode_counts, pool.first_modes);
  scan(pool.has_modes, pool.slots);
  constexpr std::size_t kWidth = Executor::kVectorWidth > 1 ? 4 : 1;  // whose modes a first-level cache holds
  executor.for_each((num_new + kWidth - 1) / kWidth,
                    GatherPixels<kWidth>{query.frame.calibration.depth, query.image.view(), query.image.downscale(), leaf_modes,
                                         forest.num_trees, num_leaves, part, pool.sampled.data(), pool.mode_counts.data(),
                                         pool.first_modes.data(), pool.slots.data(), pool.pixels.data(), pool.modes.data()});
  pool.num_filled = num_samples;
}

}  // namespace foothold

// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// The pool: a few thousand pixels with the modes of their leaves, which stand for the whole frame in everything that follows.
#pragma once

#include <cstdint>

#include "clustering/leaf_modes.h"
#include "features/leaf_lookup.h"
#include "foothold/base/array.h"

namespace foothold {

/// A pooled pixel: its camera point, its colour and its modes, which stand together in the pool's mode array.
struct PooledPixel {
  float point_camera[3];  ///< [m]
  std::uint32_t first_mode;
  std::uint16_t num_modes;
  std::uint8_t rgb[3];
  std::uint8_t reserved;
};
static_assert(sizeof(PooledPixel) == 24, "read by kernels");

/// What kernels see of the pool. Its pixels are spread evenly over the image in any prefix, so "n samples" means the first n.
struct CorrespondencePoolView {
  const PooledPixel* pixels = nullptr;
  const Mode* modes = nullptr;
  const std::uint32_t* num_pixels = nullptr;  ///< pixels with at least one mode; in device memory
};

/// Sampled pixels that are looked up together.
struct PoolPart {
  std::size_t first;
  std::size_t size;
  const std::uint32_t* leaves;  ///< tree by tree

  FOOTHOLD_HD std::uint32_t leaf(std::size_t i, int tree) const { return leaves[static_cast<std::size_t>(tree) * size + (i - first)]; }
};

/// Owns the pool, and what filling it needs.
struct CorrespondencePool {
  CorrespondencePool(const Memory& memory, int pool_size)
      : sampled(memory, static_cast<std::size_t>(pool_size)),
        leaves(memory),
        mode_counts(memory, sampled.size()),
        first_modes(memory, sampled.size() + 1),
        has_modes(memory, sampled.size()),
        slots(memory, sampled.size() + 1),
        pixels(memory, sampled.size()),
        modes(memory) {}

  /// Sizes what depends on the forest. @param max_modes  of a leaf.
  void make_room(int num_trees, int max_modes) {
    leaves.resize(sampled.size() * static_cast<std::size_t>(num_trees));
    modes.resize(leaves.size() * static_cast<std::size_t>(max_modes));
  }

  CorrespondencePoolView view() const { return first(num_filled); }
  /// What stands for the first samples of those that were looked up.
  CorrespondencePoolView first(std::size_t num_samples) const { return {pixels.data(), modes.data(), slots.data() + num_samples}; }

  Array<SampledPixel> sampled;
  std::size_t num_filled = 0;   ///< of the sampled pixels, those that were looked up
  PoolPart first_part{};        ///< those that were looked up first
  Array<std::uint32_t> leaves;  ///< part by part, tree by tree
  Array<std::uint32_t> mode_counts;
  Array<std::uint32_t> first_modes;
  Array<std::uint32_t> has_modes;
  Array<std::uint32_t> slots;  ///< of the sampled pixels that have modes; the last is their number
  Array<PooledPixel> pixels;
  Array<Mode> modes;
};

}  // namespace foothold

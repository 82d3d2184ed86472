// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// Where there is no surface for a long way: what lets rays leap over empty space.
#pragma once

#include "foothold/base/exec/atomics.h"
#include "tsdf/tsdf_view.h"

namespace foothold {

/// Octants along each side of a region, as a power of two: four blocks.
inline constexpr int kLog2RegionOctants = 3;

/// Says which of the 64 blocks of a region have surface. Regions whose hashes collide share an answer: it may name blocks without surface,
/// never hide one that has some, and needs no search.
struct SurfaceRegions {
  std::uint64_t* blocks;  ///< a bit for each block
  int log2_size;

  FOOTHOLD_HD static std::uint64_t region_of(const BlockCoordinates& block) { return pack_key({block.x >> 2, block.y >> 2, block.z >> 2}); }
  FOOTHOLD_HD static std::uint64_t bit_of(const BlockCoordinates& block) {
    return std::uint64_t{1} << static_cast<unsigned>((block.z & 3) << 4 | (block.y & 3) << 2 | (block.x & 3));
  }
  FOOTHOLD_HD std::uint64_t blocks_with_surface(std::uint64_t region) const { return blocks[first_slot(region, log2_size)]; }
  FOOTHOLD_HD void add(const BlockCoordinates& block) const { atomic_or(blocks + first_slot(region_of(block), log2_size), bit_of(block)); }
};

}  // namespace foothold

// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// Growing a TsdfVolume: which blocks a frame wants, in an order that no thread count can change, and their insertion into the hash table.
#pragma once

#include "foothold/base/camera.h"
#include "foothold/base/exec/atomics.h"
#include "foothold/base/se3.h"
#include "foothold/fusion/tsdf_volume.h"
#include "tsdf/tsdf_view.h"

namespace foothold {

/// A depth image with its camera and pose, by value for kernels.
struct PosedDepth {
  ImageView<const float> depth;
  Intrinsics intrinsics;
  SE3 world_from_camera;
  DepthRange range;
};

/// A hash table of the keys that a frame wants, in which each is claimed by one of the samples that want it.
struct ClaimTable {
  std::uint64_t* slots;  ///< kNoKey where nothing is claimed
  int log2_slots;

  /// The slot of a key that nobody has claimed before, or -1. Which of several lanes gets it is unspecified.
  FOOTHOLD_HD std::int32_t claim(std::uint64_t key) const {
    const std::uint32_t mask = (std::uint32_t{1} << static_cast<unsigned>(log2_slots)) - 1;
    for (std::uint32_t slot = first_slot(key, log2_slots);; slot = (slot + 1) & mask) {
      const std::uint64_t found = atomic_compare_exchange(slots + slot, kNoKey, key);
      if (found == kNoKey) return static_cast<std::int32_t>(slot);
      if (found == key) return -1;
    }
  }
};

/// Every so many pixels, in both directions, allocate the blocks along their ray (T: fusion_benchmark, kitchen).
inline constexpr int kAllocationStridePx = 4;

/// Claims every missing block along the truncation bands of one row of sampled pixels. Each lane remembers some blocks that need no search:
/// neighbouring pixels want nearly the same.
template <int kNumRemembered>
struct CollectWantedBlocks {
  TsdfView volume;
  PosedDepth camera;
  int num_columns;
  int num_steps;  ///< samples along the band, half a block apart or closer
  ClaimTable claims;
  std::int32_t* claimed_slots;
  std::uint32_t* claimed;  ///< 1 where the slot is

  template <class Team>
  FOOTHOLD_HD void operator()(const Team& team, std::size_t row) const {
    std::uint64_t remembered[kNumRemembered];
    for (std::uint64_t& key : remembered) key = kNoKey;
    for (int column = team.lane(); column < num_columns; column += team.size()) claim_band(static_cast<int>(row), column, remembered);
  }

 private:
  FOOTHOLD_HD void claim_band(int row, int column, std::uint64_t (&remembered)[kNumRemembered]) const {
    const int u = column * kAllocationStridePx;
    const int v = row * kAllocationStridePx;
    const float depth_m = camera.depth(u, v);
    const bool usable = camera.range.holds(depth_m);
    const float band_step_m = 2.0F * volume.truncation_m / static_cast<float>(num_steps - 1);
    const Eigen::Vector3f ray = camera.intrinsics.back_project(static_cast<float>(u), static_cast<float>(v), 1.0F);
    const std::size_t first_slot =
        (static_cast<std::size_t>(row) * static_cast<std::size_t>(num_columns) + static_cast<std::size_t>(column)) *
        static_cast<std::size_t>(num_steps);
    for (int k = 0; k < num_steps; ++k) {
      const std::size_t slot = first_slot + static_cast<std::size_t>(k);
      claimed[slot] = 0;
      if (!usable) continue;
      const float z = depth_m - volume.truncation_m + static_cast<float>(k) * band_step_m;
      const std::uint64_t key = key_of(camera.world_from_camera * Eigen::Vector3f(ray * z));
      std::uint64_t& known = remembered[foothold::first_slot(key, kLog2Most) % kNumRemembered];
      if (key == known || key == kNoKey) continue;
      known = key;
      if (volume.find(key) >= 0) continue;
      claimed_slots[slot] = claims.claim(key);
      claimed[slot] = claimed_slots[slot] >= 0 ? 1 : 0;
    }
  }

  static constexpr int kLog2Most = 16;

  FOOTHOLD_HD std::uint64_t key_of(const Eigen::Vector3f& point_world) const {
    const float scale = 1.0F / (volume.voxel_size_m * static_cast<float>(kBlockSide));
    const Eigen::Vector3f block = point_world * scale;
    const float limit = static_cast<float>(kReachBlocks);
    if (!(std::abs(block.x()) < limit && std::abs(block.y()) < limit && std::abs(block.z()) < limit)) return kNoKey;
    return pack_key({floor_to_int(block.x()), floor_to_int(block.y()), floor_to_int(block.z())});
  }
};

/// Takes the claimed keys out of the table, which is empty again afterwards.
struct TakeClaims {
  ClaimTable claims;
  const std::int32_t* claimed_slots;
  const std::uint32_t* claimed;
  const std::uint32_t* offsets;
  std::uint64_t* keys;

  FOOTHOLD_HD void operator()(std::size_t i) const {
    if (claimed[i] == 0) return;
    std::uint64_t& slot = claims.slots[claimed_slots[i]];
    keys[offsets[i]] = slot;
    slot = kNoKey;
  }
};

struct CopyKeys {
  const std::uint64_t* from;
  std::uint64_t* to;

  FOOTHOLD_HD void operator()(std::size_t i) const { to[i] = from[i]; }
};

/// Enters blocks first, first + 1, ... into the hash table.
///
/// Lanes race for slots, so a block's slot may differ from run to run; what a search finds does not.
struct InsertBlocks {
  const std::uint64_t* block_keys;
  std::uint64_t* slot_keys;
  std::int32_t* slot_blocks;
  TsdfView volume;
  int first;

  FOOTHOLD_HD void operator()(std::size_t i) const {
    const int block = first + static_cast<int>(i);
    const std::uint64_t key = block_keys[block];
    const std::uint32_t mask = (std::uint32_t{1} << static_cast<unsigned>(volume.log2_slots)) - 1;
    std::uint32_t slot = volume.first_slot(key);
    while (atomic_compare_exchange(slot_keys + slot, kNoKey, key) != kNoKey) slot = (slot + 1) & mask;
    slot_blocks[slot] = block;
  }
};

/// Empties the slots of a hash table.
struct ClearSlots {
  std::uint64_t* slot_keys;

  FOOTHOLD_HD void operator()(std::size_t slot) const { slot_keys[slot] = kNoKey; }
};

/// Marks every voxel of blocks first, first + 1, ... unobserved.
struct ClearBlocks {
  TsdfView volume;
  std::uint8_t* surface_octants;
  int first;

  template <class Team>
  FOOTHOLD_HD void operator()(const Team& team, std::size_t i) const {
    const int index = first + static_cast<int>(i);
    VoxelBlock& block = volume.block(index);
    for (int voxel = team.lane(); voxel < kBlockVoxels; voxel += team.size()) {
      block.distance[voxel] = kUnobserved;
      block.weight[voxel] = 0;
      block.red[voxel] = 0;
      block.green[voxel] = 0;
      block.blue[voxel] = 0;
    }
    if (team.lane() == 0) surface_octants[index] = 0;
  }
};

}  // namespace foothold

// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// Growing a TsdfVolume: which blocks a frame wants, in an order that no thread count can change, and their insertion into the hash table.
#pragma once

#include "device_atomics.h"
#include "foothold/base/camera.h"
#include "foothold/base/se3.h"
#include "tsdf_view.h"

namespace foothold {

/// A depth image with its camera and pose, by value for kernels.
struct PosedDepth {
  ImageView<const float> depth;
  Intrinsics intrinsics;
  SE3 world_from_camera;
  float min_depth_m = 0.0F;
  float max_depth_m = 0.0F;

  FOOTHOLD_HD bool usable(float depth_m) const { return depth_m >= min_depth_m && depth_m <= max_depth_m; }
};

/// Wants every missing block along the truncation band of one sampled pixel.
struct CollectWantedBlocks {
  TsdfView volume;
  PosedDepth camera;
  int stride_px;
  int num_columns;
  int num_steps;  ///< samples along the band, half a block apart or closer
  std::uint64_t* keys;
  std::uint32_t* wanted;

  FOOTHOLD_HD void operator()(std::size_t sample) const {
    const int u = static_cast<int>(sample) % num_columns * stride_px;
    const int v = static_cast<int>(sample) / num_columns * stride_px;
    const float depth_m = camera.depth(u, v);
    const bool usable = camera.usable(depth_m);
    const float band_step_m = 2.0F * volume.truncation_m / static_cast<float>(num_steps - 1);
    std::uint64_t last = kNoKey;
    for (int k = 0; k < num_steps; ++k) {
      const std::size_t slot = sample * static_cast<std::size_t>(num_steps) + static_cast<std::size_t>(k);
      wanted[slot] = 0;
      if (!usable) continue;
      const float z = depth_m - volume.truncation_m + static_cast<float>(k) * band_step_m;
      const Eigen::Vector3f point_world =
          camera.world_from_camera * camera.intrinsics.back_project(static_cast<float>(u), static_cast<float>(v), z);
      const std::uint64_t key = key_of(point_world);
      if (key == last || key == kNoKey) continue;
      last = key;
      if (volume.find(key) >= 0) continue;
      keys[slot] = key;
      wanted[slot] = 1;
    }
  }

  FOOTHOLD_HD std::uint64_t key_of(const Eigen::Vector3f& point_world) const {
    const float scale = 1.0F / (volume.voxel_size_m * static_cast<float>(kBlockSide));
    const Eigen::Vector3f block = point_world * scale;
    const float limit = static_cast<float>(kKeyBias - 2);  // leaves room for neighbours
    if (!(std::abs(block.x()) < limit && std::abs(block.y()) < limit && std::abs(block.z()) < limit)) return kNoKey;
    return pack_key({floor_to_int(block.x()), floor_to_int(block.y()), floor_to_int(block.z())});
  }
};

/// Keeps the flagged keys, in order.
struct CompactKeys {
  const std::uint64_t* keys;
  const std::uint32_t* flags;
  const std::uint32_t* offsets;
  std::uint64_t* kept;

  FOOTHOLD_HD void operator()(std::size_t i) const {
    if (flags[i] != 0) kept[offsets[i]] = keys[i];
  }
};

struct CopyKeys {
  const std::uint64_t* from;
  std::uint64_t* to;

  FOOTHOLD_HD void operator()(std::size_t i) const { to[i] = from[i]; }
};

/// Flags the first of equal neighbours in a sorted list.
struct FlagFirstOfEqual {
  const std::uint64_t* keys;
  std::uint32_t* flags;

  FOOTHOLD_HD void operator()(std::size_t i) const { flags[i] = i == 0 || keys[i] != keys[i - 1] ? 1U : 0U; }
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

struct NoScratch {};

/// Marks every voxel of blocks first, first + 1, ... unobserved.
struct ClearBlocks {
  TsdfView volume;
  std::uint8_t* surface_octants;
  int first;

  template <class Team>
  FOOTHOLD_HD void operator()(const Team& team, NoScratch&, std::size_t i) const {
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

// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// Growing a TsdfVolume and averaging frames into it, for both devices.
#pragma once

#include "tsdf/integration_kernels.h"
#include "tsdf/tsdf_buffers.h"

namespace foothold {

/// The steps of TsdfVolume that run on a device.
template <class Executor>
struct TsdfAlgorithms {
  using Scratch = TsdfVolume::Scratch;

  /// Fills scratch.new_keys with the missing blocks that a frame wants; returns how many.
  static int find_new_blocks(const Context& context, const TsdfView& volume, const PosedDepth& camera, Scratch& scratch);
  /// Empties the hash table and enters all blocks.
  static void rebuild_table(const Context& context, const TsdfView& volume, const TsdfTables& tables);
  /// Gives blocks [first, volume.num_blocks) the keys in scratch.new_keys, clears them and enters them into the hash table.
  static void add_blocks(const Context& context, const TsdfView& volume, const TsdfTables& tables, int first, const Scratch& scratch);
  /// Averages a frame into every block it sees.
  static void integrate(const Context& context, const TsdfView& volume, const TsdfTables& tables, const PosedDepth& camera,
                        const PosedColour& colour, int max_weight, Scratch& scratch);
};

/// Gives the table of claims room for as many as there may be: at most half of the slots are taken, so that searches stay short.
template <class Executor>
void reserve_claims(const Executor& exec, std::size_t num_claims, TsdfVolume::Scratch& scratch) {
  int log2_slots = 1;
  while ((std::size_t{1} << static_cast<unsigned>(log2_slots)) < 2 * num_claims) ++log2_slots;
  if (log2_slots <= scratch.log2_claims) return;
  scratch.claims.resize(std::size_t{1} << static_cast<unsigned>(log2_slots));
  scratch.log2_claims = log2_slots;
  exec.for_each(scratch.claims.size(), ClearSlots{scratch.claims.data()});
}

template <class Executor>
int TsdfAlgorithms<Executor>::find_new_blocks(const Context& context, const TsdfView& volume, const PosedDepth& camera, Scratch& scratch) {
  const Executor exec(context);
  const int num_columns = (camera.depth.width + kAllocationStridePx - 1) / kAllocationStridePx;
  const int num_rows = (camera.depth.height + kAllocationStridePx - 1) / kAllocationStridePx;
  const float half_block_m = 0.5F * volume.voxel_size_m * static_cast<float>(kBlockSide);
  const int num_steps = 1 + static_cast<int>(std::ceil(2.0F * volume.truncation_m / half_block_m - 1e-3F));
  const std::size_t num_samples = static_cast<std::size_t>(num_columns) * static_cast<std::size_t>(num_rows);
  const std::size_t num_candidates = num_samples * static_cast<std::size_t>(num_steps);
  scratch.claimed_slots.resize(num_candidates);
  scratch.claimed.resize(num_candidates);
  scratch.offsets.resize(num_candidates + 1);
  scratch.new_keys.resize(num_candidates);
  reserve_claims(exec, num_candidates, scratch);
  const ClaimTable claims{scratch.claims.data(), scratch.log2_claims};
  constexpr int kNumRemembered = Executor::kVectorWidth > 1 ? 64 : 1;
  exec.for_each_team(static_cast<std::size_t>(num_rows),
                     CollectWantedBlocks<kNumRemembered>{volume, camera, num_columns, num_steps, claims, scratch.claimed_slots.data(),
                                                         scratch.claimed.data()});
  exec.exclusive_scan(Span<const std::uint32_t>(scratch.claimed.data(), num_candidates),
                      Span<std::uint32_t>(scratch.offsets.data(), num_candidates + 1));
  const std::size_t num_wanted = scratch.offsets.read(context, num_candidates);
  if (num_wanted == 0) return 0;
  exec.for_each(num_candidates,
                TakeClaims{claims, scratch.claimed_slots.data(), scratch.claimed.data(), scratch.offsets.data(), scratch.new_keys.data()});
  exec.sort(Span<std::uint64_t>(scratch.new_keys.data(), num_wanted), scratch.sort_buffer, 0, 3 * kKeyBits);
  return static_cast<int>(num_wanted);
}

template <class Executor>
void TsdfAlgorithms<Executor>::rebuild_table(const Context& context, const TsdfView& volume, const TsdfTables& tables) {
  const Executor exec(context);
  exec.for_each(std::size_t{1} << static_cast<unsigned>(volume.log2_slots), ClearSlots{tables.slot_keys});
  exec.for_each(static_cast<std::size_t>(volume.num_blocks),
                InsertBlocks{volume.block_keys, tables.slot_keys, tables.slot_blocks, volume, 0});
}

template <class Executor>
void TsdfAlgorithms<Executor>::add_blocks(const Context& context, const TsdfView& volume, const TsdfTables& tables, int first,
                                          const Scratch& scratch) {
  const Executor exec(context);
  const auto count = static_cast<std::size_t>(volume.num_blocks - first);
  exec.for_each(count, CopyKeys{scratch.new_keys.data(), tables.block_keys + first});
  exec.for_each_team(count, ClearBlocks{volume, tables.surface_octants, first});
  exec.for_each(count, InsertBlocks{volume.block_keys, tables.slot_keys, tables.slot_blocks, volume, first});
}

template <class Executor>
void TsdfAlgorithms<Executor>::integrate(const Context& context, const TsdfView& volume, const TsdfTables& tables, const PosedDepth& camera,
                                         const PosedColour& colour, int max_weight, Scratch& scratch) {
  const Executor exec(context);
  constexpr int kWidth = Executor::kVectorWidth > 1 ? kBlockSide * kBlockSide : 1;
  const int num_columns = (camera.depth.width + kDepthTilePx - 1) / kDepthTilePx;
  const int num_rows = (camera.depth.height + kDepthTilePx - 1) / kDepthTilePx;
  const std::size_t num_tiles = static_cast<std::size_t>(num_columns) * static_cast<std::size_t>(num_rows);
  scratch.tile_depths_m.resize(num_tiles);
  exec.for_each(num_tiles, FindTileDepths{camera, num_columns, scratch.tile_depths_m.data()});
  exec.for_each_team(
      static_cast<std::size_t>(volume.num_blocks),
      IntegrateBlock<kWidth>{volume, camera, camera.world_from_camera.inverse(), colour.image, colour.intrinsics, colour.colour_from_world,
                             scratch.tile_depths_m.data(), num_columns, max_weight, tables.surface_octants});
}

}  // namespace foothold

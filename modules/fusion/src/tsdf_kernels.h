// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// Definitions of TsdfOps, for the executor of either device.
#pragma once

#include "tsdf_integration_kernels.h"
#include "tsdf_ops.h"

namespace foothold {

template <Device kDevice>
int TsdfOps<kDevice>::find_new_blocks(const Context& context, const TsdfView& volume, const PosedDepth& camera, int stride_px,
                                      Scratch& scratch) {
  const typename ExecutorOf<kDevice>::Type exec(context);
  const int num_columns = (camera.depth.width + stride_px - 1) / stride_px;
  const int num_rows = (camera.depth.height + stride_px - 1) / stride_px;
  const float half_block_m = 0.5F * volume.voxel_size_m * static_cast<float>(kBlockSide);
  const int num_steps = 1 + static_cast<int>(std::ceil(2.0F * volume.truncation_m / half_block_m - 1e-3F));
  const std::size_t num_samples = static_cast<std::size_t>(num_columns) * static_cast<std::size_t>(num_rows);
  const std::size_t num_candidates = num_samples * static_cast<std::size_t>(num_steps);
  scratch.candidates.resize(num_candidates);
  scratch.wanted.resize(num_candidates);
  scratch.offsets.resize(num_candidates + 1);
  exec.for_each(num_samples,
                CollectWantedBlocks{volume, camera, stride_px, num_columns, num_steps, scratch.candidates.data(), scratch.wanted.data()});
  exec.exclusive_scan(Span<const std::uint32_t>(scratch.wanted.data(), num_candidates),
                      Span<std::uint32_t>(scratch.offsets.data(), num_candidates + 1));
  const std::size_t num_wanted = scratch.offsets.read(context, num_candidates);
  if (num_wanted == 0) return 0;

  scratch.keys.resize(num_wanted);
  exec.for_each(num_candidates, CompactKeys{scratch.candidates.data(), scratch.wanted.data(), scratch.offsets.data(), scratch.keys.data()});
  exec.sort(Span<std::uint64_t>(scratch.keys.data(), num_wanted), scratch.sort_buffer, 0, 3 * kKeyBits);
  scratch.flags.resize(num_wanted);
  scratch.unique_offsets.resize(num_wanted + 1);
  exec.for_each(num_wanted, FlagFirstOfEqual{scratch.keys.data(), scratch.flags.data()});
  exec.exclusive_scan(Span<const std::uint32_t>(scratch.flags.data(), num_wanted),
                      Span<std::uint32_t>(scratch.unique_offsets.data(), num_wanted + 1));
  const std::size_t num_unique = scratch.unique_offsets.read(context, num_wanted);
  scratch.new_keys.resize(num_unique);
  exec.for_each(num_wanted, CompactKeys{scratch.keys.data(), scratch.flags.data(), scratch.unique_offsets.data(), scratch.new_keys.data()});
  return static_cast<int>(num_unique);
}

template <Device kDevice>
void TsdfOps<kDevice>::rebuild_table(const Context& context, const TsdfView& volume, const TsdfTables& tables) {
  const typename ExecutorOf<kDevice>::Type exec(context);
  exec.for_each(std::size_t{1} << static_cast<unsigned>(volume.log2_slots), ClearSlots{tables.slot_keys});
  exec.for_each(static_cast<std::size_t>(volume.num_blocks),
                InsertBlocks{volume.block_keys, tables.slot_keys, tables.slot_blocks, volume, 0});
}

template <Device kDevice>
void TsdfOps<kDevice>::add_blocks(const Context& context, const TsdfView& volume, const TsdfTables& tables, int first,
                                  const Scratch& scratch) {
  const typename ExecutorOf<kDevice>::Type exec(context);
  const auto count = static_cast<std::size_t>(volume.num_blocks - first);
  exec.for_each(count, CopyKeys{scratch.new_keys.data(), tables.block_keys + first});
  exec.template for_each_team<NoScratch>(count, ClearBlocks{volume, tables.surface_octants, first});
  exec.for_each(count, InsertBlocks{volume.block_keys, tables.slot_keys, tables.slot_blocks, volume, first});
}

template <Device kDevice>
void TsdfOps<kDevice>::integrate(const Context& context, const TsdfView& volume, const TsdfTables& tables, const PosedDepth& camera,
                                 const PosedColour& colour, int max_weight, Scratch& scratch) {
  using Exec = typename ExecutorOf<kDevice>::Type;
  const Exec exec(context);
  constexpr int kWidth = Exec::kVectorWidth > 1 ? kBlockSide * kBlockSide : 1;
  const int num_columns = (camera.depth.width + kDepthTilePx - 1) / kDepthTilePx;
  const int num_rows = (camera.depth.height + kDepthTilePx - 1) / kDepthTilePx;
  const std::size_t num_tiles = static_cast<std::size_t>(num_columns) * static_cast<std::size_t>(num_rows);
  scratch.tile_depths_m.resize(num_tiles);
  exec.for_each(num_tiles, FindTileDepths{camera, num_columns, scratch.tile_depths_m.data()});
  exec.template for_each_team<NoScratch>(
      static_cast<std::size_t>(volume.num_blocks),
      IntegrateBlock<kWidth>{volume, camera, camera.world_from_camera.inverse(), colour.image, colour.intrinsics, colour.colour_from_world,
                             scratch.tile_depths_m.data(), num_columns, max_weight, tables.surface_octants});
}

}  // namespace foothold

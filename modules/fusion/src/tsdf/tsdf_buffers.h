// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// What TsdfVolume shares with its kernels: buffers, tables, a frame's colour.
#pragma once

#include "foothold/base/array.h"
#include "foothold/fusion/tsdf_volume.h"
#include "tsdf/allocation_kernels.h"

namespace foothold {

/// Buffers of one frame's integration, kept so that no frame allocates after warm-up.
struct TsdfVolume::Scratch {
  explicit Scratch(const Memory& memory)
      : claims(memory),
        claimed_slots(memory),
        claimed(memory),
        offsets(memory),
        new_keys(memory),
        sort_buffer(memory),
        tile_depths_m(memory) {}

  Array<std::uint64_t> claims;  ///< a hash table, empty between frames
  int log2_claims = 0;
  Array<std::int32_t> claimed_slots;
  Array<std::uint32_t> claimed;
  Array<std::uint32_t> offsets;
  Array<std::uint64_t> new_keys;  ///< what the frame wants, sorted, each once
  Array<std::uint64_t> sort_buffer;
  Array<float> tile_depths_m;
};

/// Colour of a frame, by value for kernels.
struct PosedColour {
  ColourView image;
  Intrinsics intrinsics;
  SE3 colour_from_world;
};

/// The hash table and flags of a volume, writable.
struct TsdfTables {
  std::uint64_t* block_keys = nullptr;
  std::uint64_t* slot_keys = nullptr;
  std::int32_t* slot_blocks = nullptr;
  std::uint8_t* surface_octants = nullptr;
};

static_assert(sizeof(PosedDepth) == 96 && sizeof(PosedColour) == 96 && sizeof(TsdfView) == 56,
              "made by the host's compiler, read by nvcc's code");

}  // namespace foothold

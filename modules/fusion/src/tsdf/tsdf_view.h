// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// What kernels see of a TsdfVolume: blocks of voxels behind a hash table.
#pragma once

#include <cstdint>

#include "foothold/base/image.h"
#include "foothold/base/platform.h"
#include "rounding.h"

namespace foothold {

inline constexpr int kBlockSide = 8;
inline constexpr int kBlockVoxels = kBlockSide * kBlockSide * kBlockSide;
/// Voxels along each side of an eighth of a block, the unit of empty space.
inline constexpr int kOctantSide = kBlockSide / 2;
inline constexpr int kPageBits = 9;
/// Blocks in one page of memory.
inline constexpr int kPageBlocks = 1 << kPageBits;

/// A stored distance of truncation_m.
inline constexpr float kStoredOne = 32767.0F;
/// The stored distance of a voxel that no frame has observed.
inline constexpr std::int16_t kUnobserved = -32768;
inline constexpr std::uint64_t kNoKey = ~std::uint64_t{0};

/// 8 x 8 x 8 voxels, x fastest, as a structure of arrays: a ray touches the distances alone.
struct VoxelBlock {
  std::int16_t distance[kBlockVoxels];  ///< signed distance in units of truncation_m / 32767, or kUnobserved
  std::uint8_t weight[kBlockVoxels];
  std::uint8_t red[kBlockVoxels];
  std::uint8_t green[kBlockVoxels];
  std::uint8_t blue[kBlockVoxels];
};
static_assert(sizeof(VoxelBlock) == 6 * kBlockVoxels, "blocks are saved as bytes and shared with kernels");

/// Coordinates of a block, in blocks.
struct BlockCoordinates {
  int x = 0;
  int y = 0;
  int z = 0;
};

inline constexpr int kKeyBits = 21;
inline constexpr int kKeyBias = 1 << (kKeyBits - 1);
/// Blocks that a map has on each side of the origin; leaves room for neighbours.
inline constexpr int kReachBlocks = kKeyBias - 2;

/// Packs coordinates in [-2^20, 2^20) into 63 bits, sorted by z, then y, then x.
FOOTHOLD_HD inline std::uint64_t pack_key(const BlockCoordinates& block) {
  return (static_cast<std::uint64_t>(block.z + kKeyBias) << (2 * kKeyBits)) | (static_cast<std::uint64_t>(block.y + kKeyBias) << kKeyBits) |
         static_cast<std::uint64_t>(block.x + kKeyBias);
}
FOOTHOLD_HD inline BlockCoordinates unpack_key(std::uint64_t key) {
  constexpr std::uint64_t kMask = (std::uint64_t{1} << kKeyBits) - 1;
  return {static_cast<int>(key & kMask) - kKeyBias, static_cast<int>((key >> kKeyBits) & kMask) - kKeyBias,
          static_cast<int>((key >> (2 * kKeyBits)) & kMask) - kKeyBias};
}

/// Which eighth of its block a voxel is in.
FOOTHOLD_HD inline int octant_of(int x, int y, int z) { return (z & 4) | ((y & 4) >> 1) | ((x & 4) >> 2); }

/// The slot of a hash table at which the search for a key begins: Fibonacci hashing. Reference: [Knuth1998] Sec. 6.4.
FOOTHOLD_HD inline std::uint32_t first_slot(std::uint64_t key, int log2_slots) {
  return static_cast<std::uint32_t>((key * 0x9e3779b97f4a7c15ULL) >> static_cast<unsigned>(64 - log2_slots));
}

struct TsdfView {
  VoxelBlock* const* pages = nullptr;
  const std::uint64_t* block_keys = nullptr;
  const std::uint64_t* slot_keys = nullptr;
  const std::int32_t* slot_blocks = nullptr;
  const std::uint8_t* surface_octants = nullptr;
  int num_blocks = 0;
  int log2_slots = 0;
  float voxel_size_m = 0.0F;
  float truncation_m = 0.0F;

  FOOTHOLD_HD VoxelBlock& block(int index) const { return pages[index >> kPageBits][index & (kPageBlocks - 1)]; }
  FOOTHOLD_HD std::uint32_t first_slot(std::uint64_t key) const { return foothold::first_slot(key, log2_slots); }
  /// The index of a block, or -1.
  FOOTHOLD_HD int find(std::uint64_t key) const {
    const std::uint32_t mask = (std::uint32_t{1} << static_cast<unsigned>(log2_slots)) - 1;
    for (std::uint32_t slot = first_slot(key);; slot = (slot + 1) & mask) {
      const std::uint64_t found = slot_keys[slot];
      if (found == kNoKey) return -1;  // asked first: what lies outside of the world packs to anything, kNoKey, too
      if (found == key) return slot_blocks[slot];
    }
  }
};

/// A block that was looked up.
struct FoundBlock {
  std::uint64_t key = kNoKey;
  const VoxelBlock* block = nullptr;  ///< nullptr if there is none
  unsigned surface_octants = 0;
};

/// Looks voxels up, remembering the last block: neighbours are nearly always in the same one. A reader that remembers eight finds all of
/// the blocks that meet at a corner, each in its own place.
template <int kNumRemembered = 1>
class VoxelReader {
  static_assert(kNumRemembered == 1 || kNumRemembered == 8);

 public:
  FOOTHOLD_HD explicit VoxelReader(const TsdfView& view) : view_(view) {}

  /// The block with these coordinates.
  FOOTHOLD_HD const FoundBlock& find(const BlockCoordinates& coordinates) { return find(pack_key(coordinates)); }
  FOOTHOLD_HD const FoundBlock& find(std::uint64_t key) {
    FoundBlock& found = found_[kNumRemembered == 1 ? 0 : (key & 1) | (key >> kKeyBits & 1) << 1 | (key >> (2 * kKeyBits) & 1) << 2];
    if (key != found.key) {
      const int index = view_.find(key);
      found = index >= 0 ? FoundBlock{key, &view_.block(index), view_.surface_octants[index]} : FoundBlock{key, nullptr, 0};
    }
    return found;
  }
  /// The block holding voxel (x, y, z), or nullptr.
  FOOTHOLD_HD const VoxelBlock* block_of(int x, int y, int z) { return find({x >> 3, y >> 3, z >> 3}).block; }
  FOOTHOLD_HD static int voxel_index(int x, int y, int z) { return (((z & 7) << 3 | (y & 7)) << 3) | (x & 7); }

  /// The stored distance of a voxel, or kUnobserved.
  FOOTHOLD_HD std::int16_t stored(int x, int y, int z) {
    const VoxelBlock* block = block_of(x, y, z);
    return block != nullptr ? block->distance[voxel_index(x, y, z)] : kUnobserved;
  }

  /// The distance at a point given in voxels, as a fraction of truncation_m, by trilinear interpolation. False unless all eight voxels were
  /// observed.
  FOOTHOLD_HD bool interpolate(float gx, float gy, float gz, float& distance) {
    const int x = floor_to_int(gx);
    const int y = floor_to_int(gy);
    const int z = floor_to_int(gz);
    std::int16_t corner[8] = {};
    if (!read_cell(x, y, z, corner)) return false;
    const float fx = gx - static_cast<float>(x);
    const float fy = gy - static_cast<float>(y);
    const float fz = gz - static_cast<float>(z);
    float along_x[4];
    for (int i = 0; i < 4; ++i) along_x[i] = mix(corner[2 * i], corner[2 * i + 1], fx);
    const float near_z = along_x[0] + (along_x[1] - along_x[0]) * fy;
    const float far_z = along_x[2] + (along_x[3] - along_x[2]) * fy;
    distance = (near_z + (far_z - near_z) * fz) * (1.0F / kStoredOne);
    return true;
  }

  /// Where the eight voxels of a cell lie, x fastest.
  struct Cell {
    const VoxelBlock* blocks[8];  ///< nullptr where there is none
    int voxels[8];
  };
  /// Finds corner i of the cell at (x, y, z).
  FOOTHOLD_HD void find_corner(int x, int y, int z, int i, Cell& cell) {
    const int corner_x = x + (i & 1);
    const int corner_y = y + ((i >> 1) & 1);
    const int corner_z = z + (i >> 2);
    cell.blocks[i] = block_of(corner_x, corner_y, corner_z);
    cell.voxels[i] = voxel_index(corner_x, corner_y, corner_z);
  }
  /// Finds all corners of the cell at (x, y, z), each block once. For readers that remember eight: others would forget one over the next.
  FOOTHOLD_HD void find_cell(int x, int y, int z, Cell& cell) {
    const std::uint64_t key = pack_key({x >> 3, y >> 3, z >> 3});
    const unsigned reach = ((x & 7) == 7 ? 1U : 0U) | ((y & 7) == 7 ? 2U : 0U) | ((z & 7) == 7 ? 4U : 0U);  // into neighbouring blocks
    for (unsigned i = 0; i < 8; ++i) {
      const std::uint64_t step = (i & 1U) | std::uint64_t{i >> 1U & 1U} << kKeyBits | std::uint64_t{i >> 2U} << (2 * kKeyBits);
      cell.blocks[i] = (i & ~reach) != 0 ? cell.blocks[i & reach] : find(key + step).block;
      cell.voxels[i] = voxel_index(x + static_cast<int>(i & 1U), y + static_cast<int>(i >> 1U & 1U), z + static_cast<int>(i >> 2U));
    }
  }

  /// Reads the eight voxels of the cell at (x, y, z), x fastest; false if one was never observed.
  FOOTHOLD_HD bool read_cell(int x, int y, int z, std::int16_t (&corner)[8]) {
    bool observed = true;
    if constexpr (kNumRemembered == 8) {
      Cell cell;
      find_cell(x, y, z, cell);
      for (int i = 0; i < 8; ++i) {
        if (cell.blocks[i] == nullptr) return false;
        corner[i] = cell.blocks[i]->distance[cell.voxels[i]];
        observed &= corner[i] != kUnobserved;
      }
      return observed;
    }
    if ((x & 7) != 7 && (y & 7) != 7 && (z & 7) != 7) {
      const VoxelBlock* block = block_of(x, y, z);
      if (block == nullptr) return false;
      const std::int16_t* first = block->distance + voxel_index(x, y, z);
      for (int i = 0; i < 8; ++i) {
        corner[i] = first[(i & 1) + ((i >> 1) & 1) * kBlockSide + (i >> 2) * kBlockSide * kBlockSide];
        observed &= corner[i] != kUnobserved;
      }
      return observed;
    }
    // The cell reaches into neighbouring blocks: look each of them up once.
    const int reach_x = (x & 7) == 7 ? 1 : 0;
    const int reach_y = (y & 7) == 7 ? 1 : 0;
    const int reach_z = (z & 7) == 7 ? 1 : 0;
    for (int b = 0; b <= (reach_x | reach_y << 1 | reach_z << 2); ++b) {
      const int bx = b & 1;
      const int by = (b >> 1) & 1;
      const int bz = b >> 2;
      if (bx > reach_x || by > reach_y || bz > reach_z) continue;
      const VoxelBlock* block = block_of(x + bx, y + by, z + bz);
      if (block == nullptr) return false;
      for (int i = 0; i < 8; ++i) {
        const int dx = i & 1;
        const int dy = (i >> 1) & 1;
        const int dz = i >> 2;
        if ((dx & reach_x) != bx || (dy & reach_y) != by || (dz & reach_z) != bz) continue;
        corner[i] = block->distance[voxel_index(x + dx, y + dy, z + dz)];
        observed &= corner[i] != kUnobserved;
      }
    }
    return observed;
  }

 private:
  FOOTHOLD_HD static float mix(std::int16_t a, std::int16_t b, float t) {
    return static_cast<float>(a) + (static_cast<float>(b) - static_cast<float>(a)) * t;
  }

  TsdfView view_;
  FoundBlock found_[kNumRemembered];
};

}  // namespace foothold

// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// What leaves remember of a scene: reservoirs of world points with colour. Reference: [Cavallari2017] Sec. 2.2.2; [Vitter1985].
#pragma once

#include <cstdint>

#include "examples/training_examples.h"
#include "foothold/base/array.h"
#include "foothold/base/context.h"
#include "foothold/relocalisation/settings.h"
#include "reservoirs/block_lists.h"

namespace foothold {

class CheckedReader;
class CheckedWriter;

inline constexpr int kReservoirBlockSize = 16;

/// Points of one leaf, coordinate by coordinate, so that a vector register takes a whole block.
struct ReservoirBlock {
  std::int16_t x_mm[kReservoirBlockSize];
  std::int16_t y_mm[kReservoirBlockSize];
  std::int16_t z_mm[kReservoirBlockSize];
  std::uint16_t rgb565[kReservoirBlockSize];
};
static_assert(sizeof(ReservoirBlock) == 128, "two cache lines");

FOOTHOLD_HD constexpr int reservoir_blocks_for(int num_points) { return (num_points + kReservoirBlockSize - 1) / kReservoirBlockSize; }

/// What kernels see of the reservoirs.
struct LeafReservoirsView {
  BlockListsView<ReservoirBlock, 1> blocks;
  std::uint32_t* num_seen = nullptr;     ///< per leaf: points offered so far, at most kMaxSeen
  std::uint32_t* num_changed = nullptr;  ///< per leaf: points written since the leaf was last clustered
  int num_leaves = 0;
  int capacity = 0;
  std::uint64_t seed = 0;

  FOOTHOLD_HD ReservoirBlock& block_of(std::uint32_t leaf, int position) const { return blocks.at(leaf, position / kReservoirBlockSize); }
  FOOTHOLD_HD ReservoirPoint point(std::uint32_t leaf, int position) const {
    const ReservoirBlock& block = block_of(leaf, position);
    const int i = position % kReservoirBlockSize;
    return {block.x_mm[i], block.y_mm[i], block.z_mm[i], block.rgb565[i]};
  }
  FOOTHOLD_HD void set_point(std::uint32_t leaf, int position, const ReservoirPoint& point) const {
    ReservoirBlock& block = block_of(leaf, position);
    const int i = position % kReservoirBlockSize;
    block.x_mm[i] = point.x_mm;
    block.y_mm[i] = point.y_mm;
    block.z_mm[i] = point.z_mm;
    block.rgb565[i] = point.rgb565;
  }
  FOOTHOLD_HD int num_stored(std::uint32_t leaf) const {
    return num_seen[leaf] < static_cast<std::uint32_t>(capacity) ? static_cast<int>(num_seen[leaf]) : capacity;
  }
};

/// Reservoirs of all leaves.
class LeafReservoirs {
 public:
  LeafReservoirs(const Context& context, int num_leaves, const ReservoirSettings& settings, std::uint64_t seed);

  /// Adds each example to the reservoirs of its leaves (step 2), in the order of the examples whatever the number of threads.
  void insert(const Context& context, const TrainingExamples& examples);

  /// Forgets every second point of each leaf, and all points of leaves that have fewer than `min_points`. What is kept are the leaf's
  /// points now, as if no others had been offered. Rare, and made on the host.
  /// @return False, and nothing is changed, if that would give back less than a fifth of the points' memory.
  bool thin(const Context& context, int min_points);

  LeafReservoirsView view();
  std::size_t state_bytes(const Context& context) const;
  void clear();

  void save(CheckedWriter& writer) const;
  void load(CheckedReader& reader);

 private:
  ReservoirSettings settings_;
  std::uint64_t seed_;
  int num_leaves_;
  BlockLists<ReservoirBlock, 1> blocks_;
  Array<std::uint32_t> num_seen_;
  Array<std::uint32_t> num_changed_;
  // Scratch of insert().
  Array<std::uint64_t> keys_;
  Array<std::uint64_t> sort_buffer_;
  Array<std::uint32_t> new_blocks_;
  Array<std::uint32_t> first_new_block_;
};

}  // namespace foothold

// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// The bodies of leaf_modes.h, for both devices: which leaves to renew, and putting their new modes in place.
#pragma once

#include "clustering/leaf_colours.h"
#include "clustering/leaf_modes.h"
#include "clustering/quick_shift.h"

namespace foothold {

/// Larger changes count as this many; bounds the bits to sort by.
inline constexpr std::uint32_t kMaxPriority = 1023;
inline constexpr int kPriorityBits = 10;

/// Sort keys of leaves: those that changed most come first. Leaves are visited in a scattered order, so that ties favour no tree: a few
/// one after the other, which costs one division.
template <int kWidth>
struct MakePriorityKeys {
  LeafReservoirsView reservoirs;
  std::uint32_t min_points;
  std::uint32_t stride;  ///< below the number of leaves and coprime to it
  std::uint64_t* keys;

  FOOTHOLD_HD void operator()(std::size_t group) const {
    const auto num_leaves = static_cast<std::uint32_t>(reservoirs.num_leaves);
    const auto first = static_cast<std::uint32_t>(group) * static_cast<std::uint32_t>(kWidth);
    const std::uint32_t end = num_leaves - first < kWidth ? num_leaves : first + kWidth;
    auto leaf = static_cast<std::uint32_t>(static_cast<std::uint64_t>(first) * stride % num_leaves);
    for (std::uint32_t i = first; i < end; ++i) {
      std::uint32_t priority = reservoirs.num_changed[leaf];
      if (reservoirs.num_seen[leaf] < min_points) priority = 0;
      if (priority > kMaxPriority) priority = kMaxPriority;
      keys[i] = (static_cast<std::uint64_t>(kMaxPriority - priority) << kLeafShift) | leaf;
      leaf = leaf + stride < num_leaves ? leaf + stride : leaf + stride - num_leaves;
    }
  }
};

/// The leaf of a slot: by priority, or in round-robin order. num_leaves if the slot stays free.
struct ChooseLeaf {
  LeafReservoirsView reservoirs;
  const std::uint64_t* keys;  ///< sorted by priority; nullptr for round robin
  std::uint32_t cursor;
  std::uint32_t* chosen;
  std::uint32_t* costs;  ///< points to cluster

  FOOTHOLD_HD void operator()(std::size_t slot) const {
    const auto num_leaves = static_cast<std::uint32_t>(reservoirs.num_leaves);
    std::uint32_t leaf = num_leaves;
    if (slot < num_leaves) {
      if (keys == nullptr) {
        leaf = (cursor + static_cast<std::uint32_t>(slot)) % num_leaves;
      } else if ((keys[slot] >> kLeafShift) < kMaxPriority) {
        leaf = static_cast<std::uint32_t>(keys[slot] & 0xffffffffU);
      }
    }
    chosen[slot] = leaf;
    costs[slot] = static_cast<std::uint32_t>(leaf < num_leaves ? reservoirs.num_stored(leaf) : 0);
  }
};

/// Clusters the leaf of one slot and counts the pool blocks that its modes need.
template <class Executor>
struct ClusterLeaf {
  LeafReservoirsView reservoirs;
  LeafModesView leaf_modes;
  ClusteringSettings settings;
  const std::uint32_t* cost_before;
  std::uint32_t* chosen;
  Mode* new_modes;
  std::uint32_t* num_new_modes;
  std::uint32_t* new_blocks;

  FOOTHOLD_HD void operator()(const typename Executor::Team& team, QuickShiftScratch& scratch, std::size_t slot) const {
    const std::uint32_t leaf = chosen[slot];
    const bool affordable = settings.point_budget == 0 || cost_before[slot] < static_cast<std::uint32_t>(settings.point_budget);
    team.sync();
    if (leaf >= static_cast<std::uint32_t>(reservoirs.num_leaves) || !affordable) {
      if (team.lane() == 0) {
        chosen[slot] = static_cast<std::uint32_t>(reservoirs.num_leaves);
        new_blocks[slot] = 0;
      }
      return;
    }
    const QuickShift<typename Executor::Team, Executor::kVectorWidth> quick_shift{team,     scratch, reservoirs,
                                                                                  settings, leaf,    reservoirs.num_stored(leaf)};
    const bool enough = reservoirs.num_stored(leaf) >= settings.min_cluster_size;
    const int num_modes = enough ? quick_shift.run(new_modes + slot * static_cast<std::size_t>(settings.max_modes)) : 0;
    if (team.lane() == 0) {
      const auto wanted = static_cast<std::uint32_t>(leaf_modes.modes.blocks_for(num_modes));
      const std::uint32_t owned = leaf_modes.num_owned_blocks[leaf];
      num_new_modes[slot] = static_cast<std::uint32_t>(num_modes);
      new_blocks[slot] = wanted > owned ? wanted - owned : 0;
      reservoirs.num_changed[leaf] = 0;
    }
  }
};

/// Puts the new modes of one slot in place.
struct CommitModes {
  LeafModesView leaf_modes;
  int num_leaves;
  int max_modes;
  const std::uint32_t* chosen;
  const Mode* new_modes;
  const std::uint32_t* num_new_modes;
  const std::uint32_t* first_new_block;
  const std::uint32_t* num_used_blocks;

  FOOTHOLD_HD void operator()(std::size_t slot) const {
    const std::uint32_t leaf = chosen[slot];
    if (leaf >= static_cast<std::uint32_t>(num_leaves)) return;
    const auto num_modes = static_cast<int>(num_new_modes[slot]);
    std::uint32_t next_block = *num_used_blocks + first_new_block[slot];
    std::uint32_t& owned = leaf_modes.num_owned_blocks[leaf];
    while (static_cast<int>(owned) < leaf_modes.modes.blocks_for(num_modes)) {
      const int block = static_cast<int>(owned++);
      leaf_modes.modes.own(leaf, block, next_block++);
      for (int k = 0; k < kModeBlockSize; ++k) leaf_modes.modes.at(leaf, block * kModeBlockSize + k) = Mode{};  // saved even if unused
    }
    LeafColours colours = 0;
    for (int k = 0; k < num_modes; ++k) {
      const Mode& mode = new_modes[slot * static_cast<std::size_t>(max_modes) + static_cast<std::size_t>(k)];
      leaf_modes.modes.at(leaf, k) = mode;
      colours = with_colour(colours, k, mode.rgb);
    }
    leaf_modes.num_modes[leaf] = num_new_modes[slot];
    leaf_modes.colours[leaf] = colours;
  }
};

/// Scratch memory of one update.
struct ClusteringBuffers {
  Array<std::uint64_t>& keys;
  Array<std::uint64_t>& sort_buffer;
  Array<std::uint32_t>& costs;
  Array<std::uint32_t>& cost_before;
  Array<std::uint32_t>& chosen;
  Array<Mode>& new_modes;
  Array<std::uint32_t>& num_new_modes;
  Array<std::uint32_t>& new_blocks;
  Array<std::uint32_t>& first_new_block;
};

template <class Executor>
struct ClusteringAlgorithms {
  static void update(const Context& context, const LeafReservoirsView& reservoirs, const LeafModesView& leaf_modes,
                     const ClusteringSettings& settings, std::uint32_t cursor, std::uint32_t stride, const ClusteringBuffers& buffers,
                     std::uint32_t* num_used_blocks);
};

template <class Executor>
void ClusteringAlgorithms<Executor>::update(const Context& context, const LeafReservoirsView& reservoirs, const LeafModesView& leaf_modes,
                                            const ClusteringSettings& settings, std::uint32_t cursor, std::uint32_t stride,
                                            const ClusteringBuffers& buffers, std::uint32_t* num_used_blocks) {
  const Executor executor(context);
  const std::size_t num_slots = buffers.chosen.size();
  if (settings.touched_first) {
    constexpr int kWidth = Executor::kVectorWidth;
    const auto min_points = static_cast<std::uint32_t>(settings.min_cluster_size);
    executor.for_each((static_cast<std::size_t>(reservoirs.num_leaves) + kWidth - 1) / kWidth,
                      MakePriorityKeys<kWidth>{reservoirs, min_points, stride, buffers.keys.data()});
    executor.sort(Span<std::uint64_t>(buffers.keys), buffers.sort_buffer, kLeafShift, kLeafShift + kPriorityBits);
  }
  const std::uint64_t* keys = settings.touched_first ? buffers.keys.data() : nullptr;
  executor.for_each(num_slots, ChooseLeaf{reservoirs, keys, cursor, buffers.chosen.data(), buffers.costs.data()});
  executor.exclusive_scan(Span<const std::uint32_t>(buffers.costs), Span<std::uint32_t>(buffers.cost_before));
  executor.template for_each_team<QuickShiftScratch>(
      num_slots, ClusterLeaf<Executor>{reservoirs, leaf_modes, settings, buffers.cost_before.data(), buffers.chosen.data(),
                                       buffers.new_modes.data(), buffers.num_new_modes.data(), buffers.new_blocks.data()});
  executor.exclusive_scan(Span<const std::uint32_t>(buffers.new_blocks), Span<std::uint32_t>(buffers.first_new_block));
  executor.for_each(num_slots,
                    CommitModes{leaf_modes, reservoirs.num_leaves, settings.max_modes, buffers.chosen.data(), buffers.new_modes.data(),
                                buffers.num_new_modes.data(), buffers.first_new_block.data(), num_used_blocks});
  executor.for_each(1, AddTotal{buffers.first_new_block.data() + num_slots, num_used_blocks});
}

}  // namespace foothold

// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// The bodies of leaf_reservoirs.h, for both devices.
#pragma once

#include "examples/training_examples_kernels.h"
#include "foothold/base/random.h"
#include "reservoirs/leaf_reservoirs.h"

namespace foothold {

inline constexpr int kLeafShift = 32;  ///< sort keys hold the leaf above, the example below

struct MakeLeafKey {
  const std::uint32_t* leaves;
  std::uint64_t* keys;
  FOOTHOLD_HD void operator()(std::size_t i) const { keys[i] = (static_cast<std::uint64_t>(leaves[i]) << kLeafShift) | i; }
};

FOOTHOLD_HD inline std::uint32_t leaf_of(std::uint64_t key) { return static_cast<std::uint32_t>(key >> kLeafShift); }

/// True where a run of equal leaves starts.
FOOTHOLD_HD inline bool starts_run(const Span<const std::uint64_t>& keys, std::size_t i, int num_leaves) {
  const std::uint32_t leaf = leaf_of(keys[i]);
  return leaf < static_cast<std::uint32_t>(num_leaves) && (i == 0 || leaf_of(keys[i - 1]) != leaf);
}

FOOTHOLD_HD inline std::size_t end_of_run(const Span<const std::uint64_t>& keys, std::size_t begin) {
  std::size_t end = begin + 1;
  while (end < keys.size() && leaf_of(keys[end]) == leaf_of(keys[begin])) ++end;
  return end;
}

/// Counts the pool blocks that each touched leaf needs for its new points.
struct CountNewBlocks {
  LeafReservoirsView reservoirs;
  Span<const std::uint64_t> keys;
  std::uint32_t* new_blocks;

  FOOTHOLD_HD void operator()(std::size_t i) const {
    new_blocks[i] = 0;
    if (!starts_run(keys, i, reservoirs.num_leaves)) return;
    const std::uint32_t leaf = leaf_of(keys[i]);
    const int stored = reservoirs.num_stored(leaf);
    const std::size_t wanted = static_cast<std::size_t>(stored) + (end_of_run(keys, i) - i);
    const int after = wanted < static_cast<std::size_t>(reservoirs.capacity) ? static_cast<int>(wanted) : reservoirs.capacity;
    new_blocks[i] = static_cast<std::uint32_t>(reservoir_blocks_for(after) - reservoir_blocks_for(stored));
  }
};

/// A leaf that was offered this many points takes no more. The next would be kept with a chance of capacity / 2^32.
inline constexpr std::uint32_t kMaxSeen = ~std::uint32_t{0};

/// Step 2: one worker per touched leaf adds its examples in frame order by Vitter's algorithm R.
struct InsertRun {
  LeafReservoirsView reservoirs;
  Span<const std::uint64_t> keys;
  const ReservoirPoint* points;
  std::uint32_t num_examples;
  const std::uint32_t* first_new_block;
  const std::uint32_t* num_used_blocks;

  FOOTHOLD_HD void operator()(std::size_t i) const {
    if (!starts_run(keys, i, reservoirs.num_leaves)) return;
    const std::uint32_t leaf = leaf_of(keys[i]);
    int owned = reservoir_blocks_for(reservoirs.num_stored(leaf));
    std::uint32_t next_block = *num_used_blocks + first_new_block[i];
    std::uint32_t seen = reservoirs.num_seen[leaf];
    std::uint32_t written = 0;
    const std::uint64_t leaf_seed = derive_seed(reservoirs.seed, leaf);
    const auto capacity = static_cast<std::uint32_t>(reservoirs.capacity);
    for (std::size_t k = i, end = end_of_run(keys, i); k < end && seen < kMaxSeen; ++k, ++seen) {
      const std::uint32_t drawn = seen < capacity ? seen : Random(leaf_seed, seen).below(seen + 1);
      if (drawn >= capacity) continue;
      const auto position = static_cast<int>(drawn);
      if (seen < capacity && reservoir_blocks_for(position + 1) > owned) {
        reservoirs.blocks.own(leaf, owned++, next_block++);
        reservoirs.block_of(leaf, position) = {};  // so that saved scenes hold nothing of what the memory held before
      }
      reservoirs.set_point(leaf, position, points[static_cast<std::uint32_t>(keys[k]) % num_examples]);
      ++written;
    }
    reservoirs.num_seen[leaf] = seen;
    reservoirs.num_changed[leaf] += written;
  }
};

/// Adds the total of a scan to a counter.
struct AddTotal {
  const std::uint32_t* total;
  std::uint32_t* counter;
  FOOTHOLD_HD void operator()(std::size_t) const { *counter += *total; }
};

/// Scratch memory and sizes of one insertion.
struct InsertionBuffers {
  Array<std::uint64_t>& keys;
  Array<std::uint64_t>& sort_buffer;
  Array<std::uint32_t>& new_blocks;
  Array<std::uint32_t>& first_new_block;
};

template <class Executor>
struct ReservoirAlgorithms {
  static void insert(const Context& context, const LeafReservoirsView& reservoirs, const TrainingExamples& examples,
                     const InsertionBuffers& buffers, std::uint32_t* num_used_blocks);
};

template <class Executor>
void ReservoirAlgorithms<Executor>::insert(const Context& context, const LeafReservoirsView& reservoirs, const TrainingExamples& examples,
                                           const InsertionBuffers& buffers, std::uint32_t* num_used_blocks) {
  const Executor executor(context);
  const std::size_t num_keys = examples.leaves.size();
  executor.for_each(num_keys, MakeLeafKey{examples.leaves.data(), buffers.keys.data()});
  int leaf_bits = 1;
  while ((reservoirs.num_leaves >> leaf_bits) != 0) ++leaf_bits;
  executor.sort(Span<std::uint64_t>(buffers.keys), buffers.sort_buffer, kLeafShift, kLeafShift + leaf_bits);
  const Span<const std::uint64_t> keys(buffers.keys);
  executor.for_each(num_keys, CountNewBlocks{reservoirs, keys, buffers.new_blocks.data()});
  executor.exclusive_scan(Span<const std::uint32_t>(buffers.new_blocks), Span<std::uint32_t>(buffers.first_new_block));
  executor.for_each(num_keys, InsertRun{reservoirs, keys, examples.points.data(), static_cast<std::uint32_t>(examples.points.size()),
                                        buffers.first_new_block.data(), num_used_blocks});
  executor.for_each(1, AddTotal{buffers.first_new_block.data() + num_keys, num_used_blocks});
}

}  // namespace foothold

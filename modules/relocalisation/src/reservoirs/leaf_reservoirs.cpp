// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "reservoirs/leaf_reservoirs.h"

#include <algorithm>

#include "foothold/base/checked_stream.h"
#include "foothold/base/exec/dispatch.h"
#include "foothold/base/random.h"
#include "reservoirs/leaf_reservoirs_kernels.h"

namespace foothold {

#ifdef FOOTHOLD_HAS_CUDA
extern template struct ReservoirAlgorithms<CudaExecutor>;
#endif

namespace {
constexpr std::uint64_t kReplacementStream = 1;
}  // namespace

LeafReservoirs::LeafReservoirs(const Context& context, int num_leaves, const ReservoirSettings& settings, std::uint64_t seed)
    : settings_(settings),
      seed_(seed),
      num_leaves_(num_leaves),
      blocks_(context.memory(), num_leaves, reservoir_blocks_for(settings.capacity)),
      num_seen_(context.memory(), static_cast<std::size_t>(num_leaves)),
      num_changed_(context.memory(), static_cast<std::size_t>(num_leaves)),
      keys_(context.memory()),
      sort_buffer_(context.memory()),
      new_blocks_(context.memory()),
      first_new_block_(context.memory()) {
  clear();
}

void LeafReservoirs::clear() {
  blocks_.clear();
  num_seen_.clear_to_zero();
  num_changed_.clear_to_zero();
}

LeafReservoirsView LeafReservoirs::view() {
  return {blocks_.view(), num_seen_.data(), num_changed_.data(), num_leaves_, settings_.capacity, derive_seed(seed_, kReplacementStream)};
}

std::size_t LeafReservoirs::state_bytes(const Context& context) const {
  return blocks_.state_bytes(context) + num_seen_.num_bytes() + num_changed_.num_bytes();
}

void LeafReservoirs::insert(const Context& context, const TrainingExamples& examples) {
  const std::size_t num_keys = examples.leaves.size();
  keys_.resize(num_keys);
  new_blocks_.resize(num_keys);
  first_new_block_.resize(num_keys + 1);
  const InsertionBuffers buffers{keys_, sort_buffer_, new_blocks_, first_new_block_};
  dispatch(context, [&](auto on) {
    ReservoirAlgorithms<typename decltype(on)::Executor>::insert(context, view(), examples, buffers, blocks_.num_used_blocks());
  });
}

bool LeafReservoirs::thin(const Context& context, int min_points) {
  constexpr std::size_t kLeastShare = 5;
  std::vector<std::uint32_t> num_kept = num_seen_.to_host(context);
  std::size_t num_blocks = 0;
  std::size_t num_kept_blocks = 0;
  for (std::uint32_t& count : num_kept) {
    const int num_stored = static_cast<int>(std::min(count, static_cast<std::uint32_t>(settings_.capacity)));
    count = static_cast<std::uint32_t>(num_stored < min_points ? 0 : num_stored / 2);
    num_blocks += static_cast<std::size_t>(reservoir_blocks_for(num_stored));
    num_kept_blocks += static_cast<std::size_t>(reservoir_blocks_for(static_cast<int>(count)));
  }
  if (kLeastShare * (num_blocks - num_kept_blocks) < num_blocks || num_blocks == num_kept_blocks) return false;

  std::vector<ReservoirBlock> blocks = blocks_.used_pool_to_host();
  std::vector<std::int32_t> table = blocks_.blocks_to_host();
  std::vector<ReservoirBlock> kept_blocks(num_kept_blocks);
  std::vector<std::int32_t> kept_table(table.size());
  const int max_blocks = reservoir_blocks_for(settings_.capacity);
  LeafReservoirsView from;
  from.blocks = {blocks.data(), table.data(), max_blocks};
  LeafReservoirsView to;
  to.blocks = {kept_blocks.data(), kept_table.data(), max_blocks};
  std::uint32_t next_block = 0;
  for (std::uint32_t leaf = 0; leaf < static_cast<std::uint32_t>(num_leaves_); ++leaf) {
    for (int k = 0; k < static_cast<int>(num_kept[leaf]); ++k) {
      if (k % kReservoirBlockSize == 0) to.blocks.own(leaf, k / kReservoirBlockSize, next_block++);
      to.set_point(leaf, k, from.point(leaf, 2 * k));
    }
  }
  blocks_.clear();
  blocks_.restore(Span<const ReservoirBlock>(kept_blocks), Span<const std::int32_t>(kept_table));
  num_seen_.assign(Span<const std::uint32_t>(num_kept));
  return true;
}

void LeafReservoirs::save(CheckedWriter& writer) const {
  writer.write_array(num_seen_.to_host());
  writer.write_array(num_changed_.to_host());
  writer.write_array(blocks_.blocks_to_host());
  writer.write_array(blocks_.used_pool_to_host());
}

void LeafReservoirs::load(CheckedReader& reader) {
  const auto num_leaves = static_cast<std::uint64_t>(num_leaves_);
  const int max_blocks = reservoir_blocks_for(settings_.capacity);
  const std::uint64_t num_blocks = num_leaves * static_cast<std::uint64_t>(max_blocks);
  const auto num_seen = reader.read_array<std::uint32_t>("reservoir counts", num_leaves, num_leaves);
  const auto num_changed = reader.read_array<std::uint32_t>("change counts", num_leaves, num_leaves);
  const auto blocks = reader.read_array<std::int32_t>("block references", num_blocks, num_blocks);
  const auto pool = reader.read_array<ReservoirBlock>("reservoir blocks", 0, num_blocks);
  const auto num_used = static_cast<std::int64_t>(pool.size());
  std::vector<bool> owned(pool.size(), false);
  std::uint64_t num_owned = 0;
  for (std::uint64_t leaf = 0; leaf < num_leaves; ++leaf) {
    const int stored = static_cast<int>(std::min<std::uint64_t>(num_seen[leaf], static_cast<std::uint64_t>(settings_.capacity)));
    for (int k = 0; k < reservoir_blocks_for(stored); ++k) {
      const std::int32_t block = blocks[leaf * static_cast<std::uint64_t>(max_blocks) + static_cast<std::uint64_t>(k)];
      if (block < 0 || block >= num_used)
        reader.refuse("refers to reservoir block " + std::to_string(block) + ", there are " + std::to_string(num_used));
      if (owned[static_cast<std::size_t>(block)]) reader.refuse("gives reservoir block " + std::to_string(block) + " to two leaves");
      owned[static_cast<std::size_t>(block)] = true;
      ++num_owned;
    }
  }
  if (num_owned != pool.size()) {
    reader.refuse("has " + std::to_string(pool.size()) + " reservoir blocks, of which leaves own " + std::to_string(num_owned));
  }
  num_seen_.assign(Span<const std::uint32_t>(num_seen));
  num_changed_.assign(Span<const std::uint32_t>(num_changed));
  blocks_.restore(Span<const ReservoirBlock>(pool), Span<const std::int32_t>(blocks));
}

}  // namespace foothold

// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "clustering/leaf_modes.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numeric>

#include "clustering/leaf_modes_kernels.h"
#include "foothold/base/checked_stream.h"
#include "foothold/base/exec/dispatch.h"

namespace foothold {

#ifdef FOOTHOLD_HAS_CUDA
extern template struct ClusteringAlgorithms<CudaExecutor>;
#endif

namespace {

/// A step through the leaves, below their number, that visits each once and neighbours far apart.
std::uint32_t scattering_stride(int num_leaves) {
  std::uint32_t stride = 7919;
  while (std::gcd(stride, static_cast<std::uint32_t>(num_leaves)) != 1) ++stride;
  return stride % static_cast<std::uint32_t>(num_leaves);
}

/// True unless a file made it up: its mean is one of points in whole millimetres of 16 bits, and its precision that of a Gaussian.
bool is_plausible(const Mode& mode) {
  constexpr float kReachM = 33.0F;
  const auto is_within_reach = [](float mean_m) { return std::abs(mean_m) < kReachM; };
  const auto is_finite = [](float value) { return std::isfinite(value); };
  return std::all_of(std::begin(mode.mean_m), std::end(mode.mean_m), is_within_reach) &&
         std::all_of(std::begin(mode.precision), std::end(mode.precision), is_finite) && mode.precision[0] > 0.0F &&
         mode.precision[3] > 0.0F && mode.precision[5] > 0.0F;
}

}  // namespace

LeafModes::LeafModes(const Context& context, int num_leaves, const ClusteringSettings& settings)
    : settings_(settings),
      num_leaves_(num_leaves),
      modes_(context.memory(), num_leaves, settings.max_modes),
      num_modes_(context.memory(), static_cast<std::size_t>(num_leaves)),
      num_owned_blocks_(context.memory(), static_cast<std::size_t>(num_leaves)),
      colours_(context.memory(), static_cast<std::size_t>(num_leaves)),
      keys_(context.memory(), static_cast<std::size_t>(settings.touched_first ? num_leaves : 0)),
      sort_buffer_(context.memory()),
      costs_(context.memory()),
      cost_before_(context.memory()),
      chosen_(context.memory()),
      new_modes_(context.memory()),
      num_new_modes_(context.memory()),
      new_blocks_(context.memory()),
      first_new_block_(context.memory()) {
  const auto num_slots = static_cast<std::size_t>(std::min(settings.leaves_per_frame, num_leaves));
  costs_.resize(num_slots);
  cost_before_.resize(num_slots + 1);
  chosen_.resize(num_slots);
  new_modes_.resize(num_slots * static_cast<std::size_t>(settings.max_modes));
  num_new_modes_.resize(num_slots);
  new_blocks_.resize(num_slots);
  first_new_block_.resize(num_slots + 1);
  clear();
}

void LeafModes::clear() {
  cursor_ = 0;
  modes_.clear();
  num_modes_.clear_to_zero();
  num_owned_blocks_.clear_to_zero();
  colours_.clear_to_zero();
}

std::size_t LeafModes::state_bytes(const Context& context) const {
  return modes_.state_bytes(context) + num_modes_.num_bytes() + num_owned_blocks_.num_bytes() + colours_.num_bytes();
}

void LeafModes::update(const Context& context, LeafReservoirs& reservoirs) {
  const ClusteringBuffers buffers{keys_,      sort_buffer_,   costs_,      cost_before_,    chosen_,
                                  new_modes_, num_new_modes_, new_blocks_, first_new_block_};
  dispatch(context, [&](auto on) {
    ClusteringAlgorithms<typename decltype(on)::Executor>::update(context, reservoirs.view(), view(), settings_, cursor_,
                                                                  scattering_stride(num_leaves_), buffers, modes_.num_used_blocks());
  });
  cursor_ = static_cast<std::uint32_t>((cursor_ + chosen_.size()) % static_cast<std::size_t>(num_leaves_));
}

void LeafModes::save(CheckedWriter& writer) const {
  writer.write(cursor_);
  writer.write_array(num_modes_.to_host());
  writer.write_array(num_owned_blocks_.to_host());
  writer.write_array(modes_.blocks_to_host());
  writer.write_array(modes_.used_pool_to_host());
}

void LeafModes::load(CheckedReader& reader) {
  const auto cursor = reader.read<std::uint32_t>("clustering cursor");
  const auto num_leaves = static_cast<std::uint64_t>(num_leaves_);
  const int max_blocks = decltype(modes_)::View::blocks_for(settings_.max_modes);
  const std::uint64_t num_blocks = num_leaves * static_cast<std::uint64_t>(max_blocks);
  const auto num_modes = reader.read_array<std::uint32_t>("mode counts", num_leaves, num_leaves);
  const auto num_owned = reader.read_array<std::uint32_t>("mode block counts", num_leaves, num_leaves);
  const auto blocks = reader.read_array<std::int32_t>("mode block references", num_blocks, num_blocks);
  const auto pool = reader.read_array<Mode>("modes", 0, num_blocks * kModeBlockSize);
  const auto num_used = static_cast<std::int64_t>(pool.size() / kModeBlockSize);
  std::vector<bool> taken(static_cast<std::size_t>(num_used), false);
  std::int64_t num_taken = 0;
  std::vector<LeafColours> colours(num_modes.size(), 0);
  for (std::uint64_t leaf = 0; leaf < num_leaves; ++leaf) {
    if (num_modes[leaf] > static_cast<std::uint32_t>(settings_.max_modes) || num_owned[leaf] > static_cast<std::uint32_t>(max_blocks) ||
        num_modes[leaf] > num_owned[leaf] * kModeBlockSize) {
      reader.refuse("gives leaf " + std::to_string(leaf) + " " + std::to_string(num_modes[leaf]) + " modes in " +
                    std::to_string(num_owned[leaf]) + " blocks, expected at most " + std::to_string(settings_.max_modes));
    }
    for (std::uint32_t k = 0; k < num_owned[leaf]; ++k) {
      const std::int32_t block = blocks[leaf * static_cast<std::uint64_t>(max_blocks) + k];
      if (block < 0 || block >= num_used)
        reader.refuse("refers to mode block " + std::to_string(block) + ", there are " + std::to_string(num_used));
      if (taken[static_cast<std::size_t>(block)]) reader.refuse("gives mode block " + std::to_string(block) + " to two leaves");
      taken[static_cast<std::size_t>(block)] = true;
      ++num_taken;
    }
    for (std::uint32_t k = 0; k < num_modes[leaf]; ++k) {
      const auto block = static_cast<std::size_t>(blocks[leaf * static_cast<std::uint64_t>(max_blocks) + k / kModeBlockSize]);
      const Mode& mode = pool[block * kModeBlockSize + k % kModeBlockSize];
      if (!is_plausible(mode)) reader.refuse("gives leaf " + std::to_string(leaf) + " a mode that no points have");
      colours[leaf] = with_colour(colours[leaf], static_cast<int>(k), mode.rgb);
    }
  }
  if (num_taken * kModeBlockSize != static_cast<std::int64_t>(pool.size())) {
    reader.refuse("has " + std::to_string(pool.size()) + " modes, expected " + std::to_string(num_taken) + " blocks of " +
                  std::to_string(kModeBlockSize));
  }
  cursor_ = cursor % static_cast<std::uint32_t>(num_leaves_);
  num_modes_.assign(Span<const std::uint32_t>(num_modes));
  num_owned_blocks_.assign(Span<const std::uint32_t>(num_owned));
  modes_.restore(Span<const Mode>(pool), Span<const std::int32_t>(blocks));
  colours_.assign(Span<const LeafColours>(colours));
}

}  // namespace foothold

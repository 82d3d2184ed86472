// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// Many short, growing lists of elements in one pool: list i owns blocks of kBlockSize elements, handed out as it grows.
#pragma once

#include <cstdint>

#include "foothold/base/array.h"

namespace foothold {

/// What kernels see of a BlockLists. Elements of one list are addressed by their position in it.
template <class T, int kBlockSize>
struct BlockListsView {
  T* pool = nullptr;
  std::int32_t* blocks = nullptr;  ///< num_lists x max_blocks, pool block of each list's block, valid below what the list owns
  int max_blocks = 0;

  FOOTHOLD_HD static constexpr int blocks_for(int num_elements) { return (num_elements + kBlockSize - 1) / kBlockSize; }
  /// Where the table says which block of the pool is a list's block.
  FOOTHOLD_HD std::int32_t* place_of(std::uint32_t list, int block) const {
    return blocks + (list * static_cast<std::uint32_t>(max_blocks) + static_cast<std::uint32_t>(block));
  }
  FOOTHOLD_HD T& at(std::uint32_t list, int position) const {
    const std::int32_t block = *place_of(list, position / kBlockSize);
    return pool[static_cast<std::size_t>(block) * kBlockSize + static_cast<std::size_t>(position % kBlockSize)];
  }
  FOOTHOLD_HD void own(std::uint32_t list, int block, std::uint32_t pool_block) const {
    *place_of(list, block) = static_cast<std::int32_t>(pool_block);
  }
};

/// Owns the pool. Address space for full lists is reserved at construction: on the host, pages cost memory only once they are written;
/// on CUDA devices the pool is allocated whole and kept, so that no frame ever allocates.
template <class T, int kBlockSize>
class BlockLists {
 public:
  using View = BlockListsView<T, kBlockSize>;

  BlockLists(const Memory& memory, int num_lists, int max_elements)
      : max_blocks_(View::blocks_for(max_elements)),
        pool_(memory),
        blocks_(memory, static_cast<std::size_t>(num_lists) * static_cast<std::size_t>(max_blocks_)),
        num_used_blocks_(memory, 1) {
    pool_.reserve(blocks_.size() * kBlockSize);
    clear_tables();
  }

  View view() { return {pool_.data(), blocks_.data(), max_blocks_}; }
  /// Blocks handed out so far, in the lists' memory: kernels add to it.
  std::uint32_t* num_used_blocks() { return num_used_blocks_.data(); }
  /// Waits for the context's stream.
  std::size_t state_bytes(const Context& context) const {
    return num_used_blocks_.read(context, 0) * kBlockSize * sizeof(T) + blocks_.num_bytes();
  }
  void clear() {
    if (pool_.memory().kind == MemoryKind::kHost && used_blocks() > 0) {  // gives back the pages that were written
      pool_ = Array<T>(pool_.memory());
      pool_.reserve(blocks_.size() * kBlockSize);
    }
    clear_tables();
  }

  BlockLists(BlockLists&&) noexcept = default;
  BlockLists& operator=(BlockLists&&) noexcept = default;
  BlockLists& operator=(const BlockLists&) = delete;
  BlockLists(const BlockLists& other)
      : max_blocks_(other.max_blocks_), pool_(other.pool_.memory()), blocks_(other.blocks_), num_used_blocks_(other.num_used_blocks_) {
    pool_.reserve(blocks_.size() * kBlockSize);
    copy_used(other.pool_.data(), other.pool_.memory());
  }

  /// The used part of the pool and the block table, for saving.
  std::vector<T> used_pool_to_host() const {
    std::vector<T> host(used_blocks() * static_cast<std::size_t>(kBlockSize));
    if (!host.empty()) detail::copy_memory(MemoryKind::kHost, host.data(), pool_.memory(), pool_.data(), host.size() * sizeof(T));
    return host;
  }
  std::vector<std::int32_t> blocks_to_host() const { return blocks_.to_host(); }
  /// Restores what used_pool_to_host() and blocks_to_host() returned. @pre The sizes fit; see LeafReservoirs::load.
  void restore(Span<const T> used_pool, Span<const std::int32_t> blocks) {
    blocks_.assign(blocks);
    const auto used = static_cast<std::uint32_t>(used_pool.size() / kBlockSize);
    num_used_blocks_.assign(Span<const std::uint32_t>(&used, 1));
    copy_used(used_pool.data(), MemoryKind::kHost);
  }

 private:
  std::uint32_t used_blocks() const { return num_used_blocks_.to_host()[0]; }
  void clear_tables() {
    blocks_.clear_to_zero();
    num_used_blocks_.clear_to_zero();
  }
  void copy_used(const T* from, const Memory& memory) {
    const std::size_t num_bytes = used_blocks() * kBlockSize * sizeof(T);
    if (num_bytes != 0) detail::copy_memory(pool_.memory(), pool_.data(), memory, from, num_bytes);
  }

  int max_blocks_;
  Array<T> pool_;
  Array<std::int32_t> blocks_;
  Array<std::uint32_t> num_used_blocks_;
};

}  // namespace foothold

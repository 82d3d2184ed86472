// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include <cstdlib>
#include <cstring>
#include <new>

#include "cuda_backend.h"
#include "foothold/base/array.h"

namespace foothold::detail {
namespace {
constexpr std::size_t kAlignment = 64;
}  // namespace

void* allocate_memory(MemoryKind memory, std::size_t num_bytes) {
  if (num_bytes == 0) return nullptr;
  if (memory == MemoryKind::kCuda) return cuda_allocate(num_bytes);
  void* pointer = std::aligned_alloc(kAlignment, (num_bytes + kAlignment - 1) / kAlignment * kAlignment);
  if (pointer == nullptr) throw std::bad_alloc();
  return pointer;
}

void free_memory(MemoryKind memory, void* pointer) noexcept {
  if (pointer == nullptr) return;
  if (memory == MemoryKind::kCuda) {
    cuda_free(pointer);
  } else {
    std::free(pointer);
  }
}

void copy_memory(MemoryKind to_memory, void* to, MemoryKind from_memory, const void* from, std::size_t num_bytes) {
  if (to_memory == MemoryKind::kHost && from_memory == MemoryKind::kHost) {
    std::memcpy(to, from, num_bytes);
  } else {
    cuda_copy(to, from, num_bytes);
  }
}

void clear_memory(MemoryKind memory, void* pointer, std::size_t num_bytes) {
  if (memory == MemoryKind::kHost) {
    std::memset(pointer, 0, num_bytes);
  } else {
    cuda_clear(pointer, num_bytes);
  }
}

}  // namespace foothold::detail

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

void* allocate_memory(const Memory& memory, std::size_t num_bytes) {
  if (num_bytes == 0) return nullptr;
  if (memory.kind == MemoryKind::kCuda) return cuda_allocate(memory.cuda_device, num_bytes);
  void* pointer = std::aligned_alloc(kAlignment, (num_bytes + kAlignment - 1) / kAlignment * kAlignment);
  if (pointer == nullptr) throw std::bad_alloc();
  return pointer;
}

void free_memory(const Memory& memory, void* pointer) noexcept {
  if (pointer == nullptr) return;
  if (memory.kind == MemoryKind::kCuda) {
    cuda_free(memory.cuda_device, pointer);
  } else {
    std::free(pointer);
  }
}

void copy_memory(const Memory& to_memory, void* to, const Memory& from_memory, const void* from, std::size_t num_bytes) {
  if (to_memory.kind == MemoryKind::kHost && from_memory.kind == MemoryKind::kHost) {
    std::memcpy(to, from, num_bytes);
  } else {
    cuda_copy(to_memory, to, from_memory, from, num_bytes);
  }
}

void clear_memory(const Memory& memory, void* pointer, std::size_t num_bytes) {
  if (memory.kind == MemoryKind::kHost) {
    std::memset(pointer, 0, num_bytes);
  } else {
    cuda_clear(memory.cuda_device, pointer, num_bytes);
  }
}

}  // namespace foothold::detail

// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// The CUDA side of context and memory, behind plain functions: implemented in cuda_backend.cu, or refused by no_cuda_backend.cpp.
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <string>

#include "foothold/base/array.h"

namespace foothold::detail {

/// A CUDA stream with its scratch memory.
class CudaStream {
 public:
  virtual ~CudaStream() = default;
  virtual void* stream() const = 0;
  virtual void* scratch(std::size_t num_bytes) = 0;
  virtual void synchronise() const = 0;
  /// Device to host in stream order, through page-locked memory; waits for the copies, once.
  virtual void read(Span<const MemoryRead> reads) = 0;
  /// Host to device in stream order, through page-locked memory; waits at most for a write of some calls before.
  virtual void write(void* device, const void* host, std::size_t num_bytes) = 0;
};

/// A stream of its own, or the caller's. @throws DeviceError if there is no usable device.
std::unique_ptr<CudaStream> make_cuda_stream(const std::optional<void*>& existing);
bool cuda_backend_available(std::string* reason);
void* cuda_allocate(std::size_t num_bytes);
void cuda_free(void* pointer) noexcept;
/// Copies between host and device or within the device, after all that the device was asked for; waits until done.
void cuda_copy(void* to, const void* from, std::size_t num_bytes);
void cuda_clear(void* pointer, std::size_t num_bytes);

}  // namespace foothold::detail

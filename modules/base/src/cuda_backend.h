// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// The CUDA side of context and memory, behind plain functions: implemented in cuda_backend.cu and cuda_devices.cu, or refused by
/// no_cuda_backend.cpp.
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <string>

#include "foothold/base/array.h"
#include "foothold/base/trace.h"

namespace foothold::detail {

/// A CUDA stream with its scratch memory.
class CudaStream {
 public:
  virtual ~CudaStream() = default;
  virtual void* stream() const = 0;
  virtual void* scratch(std::size_t num_bytes) = 0;
  virtual void synchronise() const = 0;
  /// What is asked of this stream from now on begins after all that was asked of the other so far.
  virtual void wait_for(CudaStream& other) = 0;
  /// Device to host in stream order, through page-locked memory; waits for the copies, once.
  virtual void read(Span<const MemoryRead> reads) = 0;
  /// Host to device in stream order, through page-locked memory; waits at most for a write of some calls before.
  virtual void write(void* device, const void* host, std::size_t num_bytes) = 0;
  /// Marks in the stream where a stage begins and where the last that began ends. The end of the outermost one waits for it, and adds the
  /// times between the marks to the trace.
  virtual void begin_stage(const char* name) = 0;
  virtual void end_stage(Trace& trace) = 0;
};

/// A stream of its own on a usable device, or the caller's. @throws InvalidSettings if the caller's belongs to another device.
std::unique_ptr<CudaStream> make_cuda_stream(int device, const std::optional<void*>& existing);
/// @throws DeviceError saying why the device cannot be used and what to do about it; InvalidSettings if there is none of this index.
void expect_usable_cuda_device(int device);
std::string cuda_device_name(int device);
void* cuda_allocate(int device, std::size_t num_bytes);
void cuda_free(int device, void* pointer) noexcept;
/// Copies to or from CUDA memory, after all that the devices there were asked for; waits until done.
void cuda_copy(const Memory& to_memory, void* to, const Memory& from_memory, const void* from, std::size_t num_bytes);
void cuda_clear(int device, void* pointer, std::size_t num_bytes);

}  // namespace foothold::detail

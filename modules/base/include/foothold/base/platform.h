// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// What differs between compilers and processors: the marks that let one function body serve host and device.
#pragma once

#if __cplusplus < 201703L
#error "Foothold needs C++17: set CMAKE_CXX_STANDARD to 17, or -std=c++17, for what includes it, and remove an older -std from its flags."
#include <foothold_needs_cxx17>  // ends the compilation here, before a page of errors that say less
#endif

#if defined(__CUDACC__)
#define FOOTHOLD_HD __host__ __device__
#else
/// Marks a function that both the host and the CUDA compiler build.
#define FOOTHOLD_HD
#endif

#if defined(__GNUC__) && !defined(__CUDACC__)
#define FOOTHOLD_INLINE inline __attribute__((always_inline))
#elif defined(__CUDACC__)
#define FOOTHOLD_INLINE __forceinline__
#else
/// Asks for inlining where a call would hide a loop from the vectoriser.
#define FOOTHOLD_INLINE inline
#endif

namespace foothold {

/// Where a computation runs.
enum class Device { kCpu, kCuda };

/// Whom memory belongs to: host pointers must never be read by a kernel, nor CUDA pointers by the host.
enum class MemoryKind { kHost, kCuda };

/// Where memory lives: on the host, or on a CUDA device. The kind alone, MemoryKind::kCuda, means CUDA's device 0.
struct Memory {
  MemoryKind kind = MemoryKind::kHost;  ///< on the host, or on a CUDA device
  int cuda_device = 0;                  ///< the index of the device, as CUDA counts them; 0 on the host

  /// A place on the host, or on the CUDA device with this index.
  // NOLINTNEXTLINE(google-explicit-constructor): a kind is a place where there is one device
  FOOTHOLD_HD constexpr Memory(MemoryKind memory_kind = MemoryKind::kHost, int device_index = 0)
      : kind(memory_kind), cuda_device(device_index) {}
};

/// True if both are the same kind of memory, on the same device.
FOOTHOLD_HD constexpr bool operator==(const Memory& a, const Memory& b) { return a.kind == b.kind && a.cuda_device == b.cuda_device; }
/// True if the kind of memory or the device differs.
FOOTHOLD_HD constexpr bool operator!=(const Memory& a, const Memory& b) { return !(a == b); }

}  // namespace foothold

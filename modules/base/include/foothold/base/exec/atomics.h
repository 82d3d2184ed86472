// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// The few atomic operations that kernels share between host and device. Each is used where the order of operations cannot change the
/// result.
#pragma once

#include <cstdint>

#include "foothold/base/platform.h"

namespace foothold {

/// Replaces `expected` by `desired` if it is there; returns what was there before.
FOOTHOLD_HD inline std::uint64_t atomic_compare_exchange(std::uint64_t* address, std::uint64_t expected, std::uint64_t desired) {
#if defined(__CUDA_ARCH__)
  static_assert(sizeof(unsigned long long) == sizeof(std::uint64_t));
  return atomicCAS(reinterpret_cast<unsigned long long*>(address), static_cast<unsigned long long>(expected),
                   static_cast<unsigned long long>(desired));
#else
  __atomic_compare_exchange_n(address, &expected, desired, false, __ATOMIC_RELAXED, __ATOMIC_RELAXED);
  return expected;
#endif
}

/// Adds to a counter.
FOOTHOLD_HD inline void atomic_add(std::uint32_t* address, std::uint32_t value) {
#if defined(__CUDA_ARCH__)
  atomicAdd(address, value);
#else
  __atomic_fetch_add(address, value, __ATOMIC_RELAXED);
#endif
}

/// Sets bits.
FOOTHOLD_HD inline void atomic_or(std::uint64_t* address, std::uint64_t bits) {
#if defined(__CUDA_ARCH__)
  atomicOr(reinterpret_cast<unsigned long long*>(address), static_cast<unsigned long long>(bits));
#else
  if ((bits & ~__atomic_load_n(address, __ATOMIC_RELAXED)) != 0) __atomic_fetch_or(address, bits, __ATOMIC_RELAXED);
#endif
}

/// Lowers a value to at most `value`.
FOOTHOLD_HD inline void atomic_lower(std::int32_t* address, std::int32_t value) {
#if defined(__CUDA_ARCH__)
  atomicMin(address, value);
#else
  std::int32_t seen = __atomic_load_n(address, __ATOMIC_RELAXED);
  while (value < seen && !__atomic_compare_exchange_n(address, &seen, value, true, __ATOMIC_RELAXED, __ATOMIC_RELAXED)) {
  }
#endif
}

}  // namespace foothold

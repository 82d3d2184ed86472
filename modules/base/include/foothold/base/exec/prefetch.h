// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// Asking for memory before it is needed.
#pragma once

#include "foothold/base/platform.h"

namespace foothold {

/// Fetches the cache line at an address that will be read soon. Does nothing for CUDA, where other threads run while one waits.
FOOTHOLD_HD FOOTHOLD_INLINE void prefetch(const void* address) {
#if defined(__GNUC__) && !defined(__CUDACC__)
  __builtin_prefetch(address);
#else
  static_cast<void>(address);
#endif
}

}  // namespace foothold

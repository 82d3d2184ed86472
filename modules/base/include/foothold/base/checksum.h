// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// Checksums of files and names for contents.
#pragma once

#include <cstddef>
#include <cstdint>

namespace foothold {

/// The 64-bit FNV-1a hash of no bytes.
inline constexpr std::uint64_t kFnvBasis = 14695981039346656037ULL;

/// Continues the 64-bit FNV-1a hash of a byte stream; start with kFnvBasis. Detects damage, not malice.
inline std::uint64_t fnv1a(std::uint64_t hash, const void* data, std::size_t num_bytes) {
  const auto* bytes = static_cast<const unsigned char*>(data);
  for (std::size_t i = 0; i < num_bytes; ++i) hash = (hash ^ bytes[i]) * 1099511628211ULL;
  return hash;
}

}  // namespace foothold

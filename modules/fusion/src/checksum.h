// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// A checksum for files: finds damage, not malice.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>

#include "foothold/base/random.h"

namespace foothold {

/// Sums bytes up eight at a time; independent of how they are divided over calls only if each call but the last adds a multiple of eight.
class Checksum {
 public:
  void add(const void* data, std::size_t num_bytes) {
    const auto* bytes = static_cast<const unsigned char*>(data);
    for (; num_bytes >= sizeof(std::uint64_t); bytes += sizeof(std::uint64_t), num_bytes -= sizeof(std::uint64_t)) {
      std::uint64_t word = 0;
      std::memcpy(&word, bytes, sizeof(word));
      add_word(word);
    }
    if (num_bytes == 0) return;
    std::uint64_t word = 0;
    std::memcpy(&word, bytes, num_bytes);
    add_word(word ^ (static_cast<std::uint64_t>(num_bytes) << 56U));
  }
  std::uint64_t value() const { return sum_; }

 private:
  void add_word(std::uint64_t word) { sum_ = mix_bits(sum_ ^ word) + 0x9e3779b97f4a7c15ULL; }

  std::uint64_t sum_ = 0;
};

}  // namespace foothold

// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// Randomness as a pure function of (seed, stream, counter): the same on every thread and device, with no state to store.
#pragma once

#include <cstdint>

#include "foothold/base/platform.h"

namespace foothold {

/// Scrambles 64 bits; every input bit changes about half of the output bits. Reference: [Steele2014] (SplitMix64's finaliser).
FOOTHOLD_HD constexpr std::uint64_t mix_bits(std::uint64_t x) {
  x = (x ^ (x >> 30U)) * 0xbf58476d1ce4e5b9ULL;
  x = (x ^ (x >> 27U)) * 0x94d049bb133111ebULL;
  return x ^ (x >> 31U);
}

/// Combines a seed with a stream number into an independent seed.
FOOTHOLD_HD constexpr std::uint64_t derive_seed(std::uint64_t seed, std::uint64_t stream) {
  return mix_bits(mix_bits(seed + 0x9e3779b97f4a7c15ULL) ^ (stream * 0xd1342543de82ef95ULL + 0x2545f4914f6cdd1dULL));
}

/// A cursor into the random sequence named by (seed, stream). Copies continue independently from the same place.
class Random {
 public:
  /// The beginning of the sequence. Streams of one seed are independent of each other.
  FOOTHOLD_HD constexpr Random(std::uint64_t seed, std::uint64_t stream) : base_(derive_seed(seed, stream)) {}

  /// The same sequence, `jump` * 2^32 numbers further on: sequences of their own for the parts of one task.
  FOOTHOLD_HD constexpr Random ahead(std::uint64_t jump) const {
    Random result = *this;
    result.counter_ += (jump << 32U) * kStep;
    return result;
  }

  /// 32 uniform bits.
  FOOTHOLD_HD constexpr std::uint32_t bits() {
    counter_ += kStep;
    return static_cast<std::uint32_t>(mix_bits(base_ + counter_) >> 32U);
  }
  /// A uniform integer in [0, n), by fixed-point multiplication. @pre n > 0
  FOOTHOLD_HD constexpr std::uint32_t below(std::uint32_t n) {
    return static_cast<std::uint32_t>((static_cast<std::uint64_t>(bits()) * n) >> 32U);
  }
  /// A uniform float in [0, 1), a multiple of 2^-24.
  FOOTHOLD_HD constexpr float uniform() { return static_cast<float>(bits() >> 8U) * 0x1p-24F; }
  /// A uniform float in [low, high).
  FOOTHOLD_HD constexpr float uniform(float low, float high) { return low + (high - low) * uniform(); }

 private:
  static constexpr std::uint64_t kStep = 0x9e3779b97f4a7c15ULL;

  std::uint64_t base_;
  std::uint64_t counter_ = 0;
};

}  // namespace foothold

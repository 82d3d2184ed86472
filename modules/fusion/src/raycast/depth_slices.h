// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// At which depths the rays of a tile may meet a surface: what lets them leap over all others at once.
#pragma once

#include <cfloat>
#include <cstdint>
#include <cstring>

#include "foothold/base/exec/atomics.h"

namespace foothold {

FOOTHOLD_HD inline std::int32_t float_bits(float value) {
  std::int32_t bits = 0;
  memcpy(&bits, &value, sizeof(bits));
  return bits;
}
FOOTHOLD_HD inline float float_of_bits(std::int32_t bits) {
  float value = 0.0F;
  memcpy(&value, &bits, sizeof(value));
  return value;
}

/// A bit for each slice of depth in which there is some surface. Slices are the longer the farther they are, 3 to 6 % of their depth:
/// sixteen between 1 m and 2 m, between 2 m and 4 m, and so on. The first begins at the camera, the last has no end.
struct DepthSlices {
  static constexpr int kNumWords = 2;
  std::uint64_t words[kNumWords] = {};

  /// Notes a surface between two depths [m].
  FOOTHOLD_HD void add(float near_m, float far_m) {
    const int first = slice_of(near_m);
    const int last = slice_of(far_m);
    for (int word = first / kWordBits; word <= last / kWordBits; ++word) {
      const int begin = first > word * kWordBits ? first % kWordBits : 0;
      const int end = last < word * kWordBits + kWordBits - 1 ? last % kWordBits : kWordBits - 1;
      atomic_or(words + word, (~std::uint64_t{0} >> static_cast<unsigned>(kWordBits - 1 - end + begin)) << static_cast<unsigned>(begin));
    }
  }

  /// The least depth from `depth_m` on at which there may be a surface [m]; FLT_MAX if there is none.
  FOOTHOLD_HD float next(float depth_m) const {
    const int slice = slice_of(depth_m);
    int word = slice / kWordBits;
    std::uint64_t bits = words[word] & (~std::uint64_t{0} << static_cast<unsigned>(slice % kWordBits));
    while (bits == 0 && ++word < kNumWords) bits = words[word];
    if (bits == 0) return FLT_MAX;
    const int found = word * kWordBits + lowest_bit(bits);
    return found == slice ? depth_m : float_of_bits(kFirstBits + (found << kShift));
  }

 private:
  static constexpr int kWordBits = 64;
  static constexpr int kShift = 19;                      ///< leaves four bits of a float's fraction
  static constexpr std::int32_t kFirstBits = 125 << 23;  ///< of 0.25 m, within the first slice; the last begins at 62 m

  /// Grows with the depth, as the bits of positive floats do.
  FOOTHOLD_HD static int slice_of(float depth_m) {
    const int slice = (float_bits(depth_m) - kFirstBits) >> kShift;
    constexpr int kLast = kNumWords * kWordBits - 1;
    return slice < 0 ? 0 : (slice > kLast ? kLast : slice);
  }

  /// The number of zeros below the lowest bit that is set.
  FOOTHOLD_HD static int lowest_bit(std::uint64_t bits) {
#if defined(__CUDA_ARCH__)
    return __ffsll(static_cast<long long>(bits)) - 1;
#else
    return __builtin_ctzll(bits);
#endif
  }
};
static_assert(sizeof(DepthSlices) == 16, "shared with kernels");

}  // namespace foothold

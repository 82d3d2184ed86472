// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// The colours of a leaf's largest modes, in one word: asked of every place whenever pixels vote, so it must be small and quick to read.
#pragma once

#include <cstdint>

#include "foothold/base/image.h"
#include "foothold/base/platform.h"

namespace foothold {

/// Up to four colours of 15 bits, five a channel. A colour's highest bit tells that there is one.
using LeafColours = std::uint64_t;

inline constexpr int kNumLeafColours = 4;

/// What a pixel counts for at most, in a place where its leaf has exactly its colour.
inline constexpr std::uint32_t kMostCloseness = 400;

/// The word of a leaf whose modes' colours are added, the largest mode first; of no effect from the fifth on.
FOOTHOLD_HD inline LeafColours with_colour(LeafColours colours, int position, const std::uint8_t* rgb) {
  if (position >= kNumLeafColours) return colours;
  const std::uint32_t packed = 0x8000U | (rgb[0] / 8U) << 10U | (rgb[1] / 8U) << 5U | rgb[2] / 8U;
  return colours | LeafColours{packed} << static_cast<unsigned>(16 * position);
}

/// How close a pixel's colour is to the nearest of a leaf's: the square of what its most different channel lacks to 20 grey levels (T,
/// docs/experiments/places.md), or 0.
FOOTHOLD_HD inline std::uint32_t closeness(LeafColours colours, const Rgb8& asked) {
  const int rgb[3] = {asked.r, asked.g, asked.b};
  constexpr int kReach = 20;
  int nearest = kReach;
  for (; colours != 0; colours >>= 16U) {
    int difference = 0;
    for (int channel = 0; channel < 3; ++channel) {
      const auto middle = static_cast<int>((colours >> static_cast<unsigned>(10 - 5 * channel) & 31U) * 8U + 4U);
      const int d = rgb[channel] > middle ? rgb[channel] - middle : middle - rgb[channel];
      difference = d > difference ? d : difference;
    }
    nearest = difference < nearest ? difference : nearest;
  }
  return static_cast<std::uint32_t>((kReach - nearest) * (kReach - nearest));
}

}  // namespace foothold

// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// What refining poses remembers of each round.
#pragma once

#include <cstdint>

#include "foothold/base/array.h"

namespace foothold {

inline constexpr std::uint16_t kNoMode = 0xffff;
inline constexpr float kRefinementRadiusM = 0.2F;  ///< (R) distance to its mode beyond which a sample does not refine a pose

/// Hypotheses are compared with modes in groups of an executor's vector width, which divides this.
inline constexpr std::size_t kLargestGroup = 16;

/// The mode that each sample was assigned for each hypothesis that is refined.
struct ModeAssignments {
  ModeAssignments(const Memory& memory, int num_refined, int pool_size)
      : nearest(memory, (static_cast<std::size_t>(num_refined) + kLargestGroup - 1) / kLargestGroup * kLargestGroup *
                            static_cast<std::size_t>(pool_size)) {}

  Array<std::uint16_t> nearest;  ///< position among the pixel's modes, or kNoMode
};

}  // namespace foothold

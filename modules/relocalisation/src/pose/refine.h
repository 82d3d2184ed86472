// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// What refining poses remembers of each round.
#pragma once

#include <cstdint>

#include "foothold/base/array.h"

namespace foothold {

inline constexpr std::uint16_t kNoMode = 0xffff;
inline constexpr float kRefinementRadiusM = 0.2F;  ///< (R) distance to its mode beyond which a sample does not refine a pose

/// Numbers of a sample with its mode: point, mean and precision.
inline constexpr std::uint32_t kNumPacked = 12;
/// Samples whose numbers stand one behind another are padded to whole vectors.
FOOTHOLD_HD constexpr std::uint32_t padded_samples(std::uint32_t num_samples) { return (num_samples + 15U) / 16U * 16U; }

/// The mode that each sample was assigned for each hypothesis that is refined.
struct ModeAssignments {
  ModeAssignments(const Memory& memory, int num_refined, int pool_size)
      : nearest(memory, static_cast<std::size_t>(num_refined) * static_cast<std::size_t>(pool_size)),
        packed(memory, memory.kind == MemoryKind::kHost ? std::size_t{kNumPacked} * static_cast<std::size_t>(num_refined) *
                                                              padded_samples(static_cast<std::uint32_t>(pool_size))
                                                        : 0) {}

  Array<std::uint16_t> nearest;  ///< position among the pixel's modes, or kNoMode
  Array<float> packed;           ///< samples with their modes, where vectors are loaded
};

}  // namespace foothold

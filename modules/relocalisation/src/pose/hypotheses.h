// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// Hypotheses of the camera's pose, and their order.
#pragma once

#include <cstdint>

#include "foothold/base/array.h"
#include "foothold/base/se3.h"

namespace foothold {

/// Energies from here on are those of failed draws.
inline constexpr float kFailedEnergy = 1e30F;

/// The hypothesis of a sort key, which has what to sort by above it.
FOOTHOLD_HD inline std::uint32_t hypothesis_of(std::uint64_t key) { return static_cast<std::uint32_t>(key & 0xffffffffU); }

/// What kernels see of the hypotheses. A slot is a place in their order.
struct HypothesesView {
  SE3* poses = nullptr;  ///< scene_from_camera
  float* energies = nullptr;
  std::uint64_t* order = nullptr;  ///< sort keys

  FOOTHOLD_HD std::uint32_t at(std::size_t slot) const { return hypothesis_of(order[slot]); }
  FOOTHOLD_HD SE3& pose_at(std::size_t slot) const { return poses[at(slot)]; }
  FOOTHOLD_HD bool has_failed(std::size_t slot) const { return energies[at(slot)] >= kFailedEnergy; }
};

/// Whether all but the first of several hypotheses have failed. Failed ones stand behind the others.
FOOTHOLD_HD inline bool is_alone(const HypothesesView& hypotheses, std::size_t num_active) {
  return num_active > 1 && hypotheses.has_failed(1);
}

/// Owns the hypotheses.
struct Hypotheses {
  Hypotheses(const Memory& memory, int num_hypotheses)
      : poses(memory, static_cast<std::size_t>(num_hypotheses)),
        energies(memory, poses.size()),
        order(memory, poses.size()),
        given_up(memory, 1),
        sort_buffer(memory) {}

  HypothesesView view() { return {poses.data(), energies.data(), order.data()}; }

  Array<SE3> poses;
  Array<float> energies;
  Array<std::uint64_t> order;
  Array<std::int32_t> given_up;  ///< 1 if a trial showed that none is worth drawing
  Array<std::uint64_t> sort_buffer;
};

}  // namespace foothold

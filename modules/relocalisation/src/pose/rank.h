// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// Points of the whole scene, and what they say about poses.
#pragma once

#include <cstdint>

#include "foothold/base/array.h"

namespace foothold {

/// Points that are drawn (T); candidates are ranked by the first kRankingPoints (T) of them.
inline constexpr int kRememberedPoints = 8192;
inline constexpr int kRankingPoints = 2048;

/// A point drawn from all that the leaves remember.
struct RememberedPoint {
  float point_scene[3];  ///< [m]
  std::uint8_t rgb[3];
  std::uint8_t valid;
};
static_assert(sizeof(RememberedPoint) == 16, "lives in device memory");

/// What remembered points say about a pose: counts of those that project to a pixel with depth.
struct SceneEvidence {
  float num_in_view;
  float num_contradicted;  ///< the camera sees through them
  float num_alike;         ///< at the measured depth, and of the measured colour

  FOOTHOLD_HD float contradicted_fraction() const { return num_contradicted / (num_in_view + kPrior); }
  FOOTHOLD_HD float alike_fraction() const { return num_alike / (num_in_view + kPrior); }

 private:
  static constexpr float kPrior = 20.0F;  ///< (T) a few points prove nothing
};
static_assert(sizeof(SceneEvidence) == 12, "lives in device memory");

/// Owns both.
struct Ranking {
  Ranking(const Memory& memory, int num_points, int num_hypotheses)
      : points(memory, static_cast<std::size_t>(num_points)), evidence(memory, static_cast<std::size_t>(num_hypotheses)) {
    evidence.clear_to_zero();
  }

  Array<RememberedPoint> points;
  Array<SceneEvidence> evidence;  ///< per hypothesis; zero for those that were not judged
};

}  // namespace foothold

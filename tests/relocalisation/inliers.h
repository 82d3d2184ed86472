// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// An oracle for what an explanation tells of its best candidate.
#pragma once

#include <algorithm>
#include <cmath>
#include <string>

#include "foothold/relocalisation/forest_relocaliser.h"
#include "support/catch.h"

namespace foothold::test {

/// An inlier's distance to its mode; modes that are exactly so far may be counted either way.
inline constexpr float kInlierDistance = 0.05F;
inline constexpr double kUndecided = 2.0;

/// Pixels with a mode within kInlierDistance of where the pose puts them.
inline int num_inliers(const Explanation& explanation, const SE3& world_from_camera) {
  int num = 0;
  for (const ExplainedPixel& pixel : explanation.pixels) {
    const Eigen::Vector3f point = world_from_camera * pixel.point_camera;
    const auto first = explanation.modes.begin() + static_cast<std::ptrdiff_t>(pixel.first_mode);
    const auto is_near = [&](const ExplainedMode& mode) { return (mode.mean_world - point).norm() < kInlierDistance; };
    num += std::any_of(first, first + static_cast<std::ptrdiff_t>(pixel.num_modes), is_near) ? 1 : 0;
  }
  return num;
}

/// Requires that the best candidate's share of inliers is that of the pixels and modes that are told, so that these are the ones it was
/// estimated from. @pre The frame has depth nearly everywhere: then every pixel of the pool has.
inline void require_accounted_for(const Explanation& explanation, const ForestRelocaliserSettings& settings) {
  const ExplainedCandidate& best = explanation.candidates.at(0);
  const double told = static_cast<double>(best.inlier_fraction) * settings.pose.pool_size;
  const int counted = num_inliers(explanation, best.world_from_camera);
  INFO(told << " told, " << counted << " counted");
  REQUIRE(std::abs(told - counted) <= kUndecided);
}

}  // namespace foothold::test

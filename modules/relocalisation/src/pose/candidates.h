// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// What an estimate answers with.
#pragma once

#include <cstdint>

#include "foothold/base/se3.h"
#include "pose/rank.h"

namespace foothold {

inline constexpr float kInlierDistanceM = 0.05F;
inline constexpr float kFineInlierDistanceM = 0.025F;

/// A hypothesis that came far, with what its pose explains of the whole pool.
struct PoseCandidate {
  SE3 scene_from_camera;
  float mean_energy = 0.0F;      ///< truncated Mahalanobis distance per pooled pixel, Eq. 4
  float inlier_fraction = 0.0F;  ///< pooled pixels with a mode within kInlierDistanceM, among all pooled pixels with depth
  float fine_fraction = 0.0F;    ///< the same within kFineInlierDistanceM
  SceneAgreement agreement{};    ///< of the best; not valid for others, or if the plan does not confront the scene
  std::int32_t valid = 0;
};
static_assert(sizeof(PoseCandidate) == 88, "copied from the device");

}  // namespace foothold

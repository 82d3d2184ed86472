// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// Turns the buffers of a finished estimation into an Explanation.
#pragma once

#include <vector>

#include "foothold/api/relocaliser.h"
#include "foothold/relocalisation/explanation.h"
#include "pose/pose_estimator.h"

namespace foothold {

/// @param estimates     what became of the candidates.
/// @param origin_world  of the scene [m].
/// @pre The estimator's last answer is the one that the estimates were made from.
Explanation explain(const PoseEstimator& estimator, const std::vector<PoseEstimate>& estimates, const Eigen::Vector3f& origin_world);

}  // namespace foothold

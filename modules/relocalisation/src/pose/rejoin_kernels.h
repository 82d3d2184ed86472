// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// Drawing the best pose to what the camera that was learnt last saw, as far as both see the same: whoever was lost a moment ago goes on
/// where tracking ended, to a few millimetres. Not in the paper. The evidence for the pose was measured before, where it was aligned.
#pragma once

#include "pose/candidates.h"
#include "pose/project_kernels.h"

namespace foothold {

/// Points of the camera that was learnt last.
struct LatestPoints {
  Span<const ReservoirPoint> points;

  FOOTHOLD_HD static float min_supported(float num_points) { return 0.6F * num_points; }
  FOOTHOLD_HD std::size_t size() const { return points.size(); }
  FOOTHOLD_HD bool get(std::size_t i, Eigen::Vector3f& point_scene) const {
    const ReservoirPoint& point = points[i];
    point_scene = Eigen::Vector3f(point.x_mm, point.y_mm, point.z_mm) * 1e-3F;
    return (point.x_mm != 0) | (point.y_mm != 0) | (point.z_mm != 0);
  }
};

/// Draws the pose that was aligned, and gives it to the best candidate. One team.
template <class Executor>
struct Rejoin {
  AlignByProjection<Executor, LatestPoints> align;
  PoseCandidate* best;

  FOOTHOLD_HD void operator()(const typename Executor::Team& team, std::size_t item) const {
    align(team, item);
    if (team.lane() == 0) best->scene_from_camera = align.state->scene_from_camera;
  }
};

/// @pre The best candidate was aligned last.
template <class Executor>
void rejoin(const Executor& executor, const PoseQuery& query, Span<const ReservoirPoint> latest, Alignment& alignment,
            Array<PoseCandidate>& candidates) {
  constexpr int kSteps = 4;            // (T)
  constexpr float kDistanceM = 0.03F;  // (T)
  if (latest.empty()) return;
  executor.for_each_team(
      1, Rejoin<Executor>{{surface_estimator(query), {latest}, kSteps, kDistanceM, alignment.state.data()}, candidates.data()});
}

}  // namespace foothold

// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// The error of whole trajectories: absolute and relative.
#pragma once

#include "foothold/base/se3.h"
#include "foothold/base/span.h"

namespace foothold {

/// How an estimated trajectory is laid over the true one.
enum class TrajectoryAlignment {
  kNone,   ///< as it is: both live in one world
  kRigid,  ///< by the rigid transform of least squares between the positions
};

/// The absolute trajectory error (ATE): distances between positions of the same frame [m].
struct AbsoluteTrajectoryError {
  double rmse_m = 0.0;    ///< root of the mean square [m]
  double mean_m = 0.0;    ///< the mean [m]
  double median_m = 0.0;  ///< the median [m]
  double max_m = 0.0;     ///< the greatest [m]
  /// The transform laid over the estimate; the identity without alignment.
  SE3 truth_from_estimate;
};

/// @pre Equal, positive numbers of poses; pose i of both belongs to the same frame.
/// Reference: [Sturm2012] Sec. V-A; alignment [Umeyama1991], without scale.
AbsoluteTrajectoryError absolute_trajectory_error(Span<const SE3> estimated, Span<const SE3> truth, TrajectoryAlignment alignment);

/// The relative pose error (RPE): drift over a fixed number of frames.
struct RelativePoseError {
  double translation_rmse_m = 0.0;  ///< root of the mean square of the distances [m]
  double rotation_rmse_rad = 0.0;   ///< root of the mean square of the angles [rad]
  int num_pairs = 0;                ///< pairs of frames that were compared
};

/// Compares the motion from frame i to frame i + delta. Both errors are 0 when the trajectory is no longer than delta.
/// @pre Equal numbers of poses; delta > 0.
/// Reference: [Sturm2012] Sec. V-B.
RelativePoseError relative_pose_error(Span<const SE3> estimated, Span<const SE3> truth, int delta);

}  // namespace foothold

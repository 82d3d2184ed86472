// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// Trajectories in the text format of the TUM RGB-D benchmark, which evaluation tools of the field understand.
#pragma once

#include <string>
#include <vector>

#include "foothold/base/se3.h"

namespace foothold {

/// A pose and its time.
struct StampedPose {
  double timestamp_s = 0.0;  ///< when the camera was there [s]
  SE3 world_from_camera;     ///< the pose
};

/// Reads lines of "timestamp tx ty tz qx qy qz qw", '#' beginning a comment.
/// @return At least one pose, by rising time; of poses with equal times, the first.
/// @throws FileError naming the line for anything but 8 finite numbers, or a quaternion whose length is not 1 to within 1e-2.
std::vector<StampedPose> read_trajectory(const std::string& path);

/// Writes a trajectory that read_trajectory() reads back to single precision. Replaces the file only when complete.
/// @param origin_m  Added to every position: Sequence::origin_m() of the recording that was followed. @throws FileError
void write_trajectory(const std::string& path, const std::vector<StampedPose>& trajectory,
                      const Eigen::Vector3d& origin_m = Eigen::Vector3d::Zero());

}  // namespace foothold

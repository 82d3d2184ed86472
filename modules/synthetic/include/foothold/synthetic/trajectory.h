// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// Smooth paths of a hand-held camera through a room.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "foothold/base/se3.h"
#include "foothold/synthetic/room.h"

namespace foothold {

/// Which of a room's two paths the camera takes.
enum class TrajectoryKind {
  kTrain,  ///< loops through the room, looking at its furniture
  kTest,   ///< follows the training path at another pace, up to about a metre beside it and turned by up to about 45 degrees
};

/// A camera path defined for all times. The training path repeats after 43 s, but for the tremor.
///
/// Positions and viewing directions are uniform cubic B-splines through random control points, so velocities and accelerations are
/// continuous; tremor adds a few millimetres and tenths of a degree. Control points are redrawn until the camera keeps its distance from
/// every surface, sees most of its view at a depth that a depth camera measures and, on the test path, until at least half of each view
/// lies in training views of the last seconds. That is checked for the first 43 s.
class Trajectory {
 public:
  /// @param seed  Varies the tremor only; the path belongs to the room.
  Trajectory(const Room& room, TrajectoryKind kind, std::uint64_t seed);

  /// The pose at a time [s], without any roll but the hand's own.
  SE3 world_from_camera(double time_s) const;

 private:
  struct Path;  // see trajectory.cpp

  TrajectoryKind kind_;
  std::uint64_t seed_;
  std::vector<Eigen::Vector3f> eyes_world_;
  std::vector<Eigen::Vector3f> directions_world_;
  std::vector<Eigen::Vector3f> eye_offsets_world_;
  std::vector<Eigen::Vector3f> turns_rad_;  ///< yaw, pitch, roll
};

}  // namespace foothold

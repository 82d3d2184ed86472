// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// How far a pose is from the truth, and when that counts as found.
#pragma once

#include <string>
#include <vector>

#include "foothold/base/se3.h"

namespace foothold {

/// The distance between two poses of the depth camera.
struct PoseError {
  double translation_m = 0.0;  ///< between the camera's centres [m]
  double rotation_rad = 0.0;   ///< the angle of the rotation between the two [rad]
};

/// The error of an estimate against the true pose.
PoseError pose_error(const SE3& world_from_camera, const SE3& world_from_camera_true);

/// A pair of limits; a pose counts if it keeps both, each inclusive.
struct PoseThreshold {
  double translation_m = 0.05;  ///< greatest distance [m]
  double rotation_deg = 5.0;    ///< greatest angle [deg]

  /// Whether an error keeps both limits.
  bool contains(const PoseError& error) const;
  /// The key used in tables and files, such as "5cm_5deg".
  std::string key() const;
};

/// The measure of the field: 5 cm and 5 deg [Shotton2013].
inline constexpr PoseThreshold kFoundThreshold = {0.05, 5.0};
/// Beyond 10 cm or 10 deg a pose is wrong: a tracker started there does not converge.
inline constexpr PoseThreshold kWrongThreshold = {0.10, 10.0};

/// The thresholds that every report shows, tightest first: 1 cm/1 deg, 2/2, 5/5 and 10/10.
const std::vector<PoseThreshold>& recall_ladder();

}  // namespace foothold

// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// The pinhole camera: x right, y down, z forward; the centre of the first pixel is (0, 0).
#pragma once

#include <Eigen/Core>

#include "foothold/base/platform.h"

namespace foothold {

/// Focal lengths and principal point [px] of an undistorted pinhole camera.
struct Intrinsics {
  float fx = 0.0F;  ///< focal length along rows [px]
  float fy = 0.0F;  ///< focal length along columns [px]
  float cx = 0.0F;  ///< column of the principal point [px]
  float cy = 0.0F;  ///< row of the principal point [px]

  /// The camera point seen at pixel (u, v) with depth z [m] along the optical axis.
  FOOTHOLD_HD Eigen::Vector3f back_project(float u, float v, float depth_m) const {
    return {(u - cx) / fx * depth_m, (v - cy) / fy * depth_m, depth_m};
  }
  /// The pixel at which a camera point is seen. @pre point_camera.z() > 0
  FOOTHOLD_HD Eigen::Vector2f project(const Eigen::Vector3f& point_camera) const {
    return {fx * point_camera.x() / point_camera.z() + cx, fy * point_camera.y() / point_camera.z() + cy};
  }
  /// The same camera on an image resized by `factor` (0.5 halves both sides), keeping pixel centres aligned.
  FOOTHOLD_HD Intrinsics scaled(float factor) const {
    return {fx * factor, fy * factor, (cx + 0.5F) * factor - 0.5F, (cy + 0.5F) * factor - 0.5F};
  }
};

/// True if the focal lengths are positive and every value is finite.
bool is_valid(const Intrinsics& intrinsics);

/// True where a depth reading is a measurement: positive and finite [m].
FOOTHOLD_HD inline bool is_valid_depth(float depth_m) { return depth_m > 0.0F && depth_m < 1e4F; }

}  // namespace foothold

// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "outside_picture.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "common/reconstruction_monitor.h"
#include "foothold/fusion/raycaster.h"

namespace foothold::replay {
namespace {

using Eigen::Vector3f;

/// How far the picture's camera looks down [rad].
constexpr float kTilt_rad = 0.6F;
/// Part of the vertices, in each direction, that may lie outside the picture: stray surfaces must not shrink the rest.
constexpr float kTail = 0.01F;
/// Half the angle of view [rad].
constexpr float kHalfView_rad = 0.35F;

/// Farther away than needed by this factor.
constexpr float kMargin = 1.05F;

struct Extent {
  float low = 0.0F;
  float high = 0.0F;
};

/// Where all but the tails of the vertices lie along an axis.
Extent extent_along(const Vector3f& axis, const std::vector<Vector3f>& vertices) {
  std::vector<float> values;
  values.reserve(vertices.size());
  for (const Vector3f& vertex : vertices) values.push_back(axis.dot(vertex));
  const auto tail = static_cast<std::ptrdiff_t>(kTail * static_cast<float>(values.size()));
  std::nth_element(values.begin(), values.begin() + tail, values.end());
  const float low = values[static_cast<std::size_t>(tail)];
  std::nth_element(values.begin(), values.end() - 1 - tail, values.end());
  return {low, *(values.end() - 1 - tail)};
}

/// The rotation of a camera whose columns are right, down and forward: level, and tilted down.
Eigen::Matrix3f look_down(const std::vector<SE3>& trajectory) {
  Vector3f up = Vector3f::Zero();
  Vector3f forward = Vector3f::Zero();
  for (const SE3& world_from_camera : trajectory) {
    up -= world_from_camera.rotation.col(1);
    forward += world_from_camera.rotation.col(2);
  }
  up = up.norm() > 1e-3F ? up.normalized() : Vector3f(-trajectory.front().rotation.col(1));
  forward -= up * up.dot(forward);
  forward = forward.norm() > 1e-3F ? forward.normalized() : up.unitOrthogonal();
  const Vector3f down_the_slope = (std::cos(kTilt_rad) * forward - std::sin(kTilt_rad) * up).normalized();
  const Vector3f right = forward.cross(up);
  Eigen::Matrix3f rotation;
  rotation << right, down_the_slope.cross(right), down_the_slope;
  return rotation;
}

}  // namespace

Image<Rgb8> picture_from_outside(const TsdfVolume& volume, const Mesh& mesh, const std::vector<SE3>& trajectory, int width, int height) {
  if (mesh.vertices.empty() || trajectory.empty()) return {};
  const Eigen::Matrix3f rotation = look_down(trajectory);
  Vector3f centre = Vector3f::Zero();
  float distance_m = 0.0F;
  const float focal_px = 0.5F * static_cast<float>(width) / std::tan(kHalfView_rad);
  const float image_px[2] = {static_cast<float>(width), static_cast<float>(height)};
  float half_depth_m = 0.0F;
  for (int axis = 0; axis < 3; ++axis) {
    const Extent extent = extent_along(rotation.col(axis), mesh.vertices);
    centre += rotation.col(axis) * 0.5F * (extent.low + extent.high);
    if (axis < 2) {
      distance_m = std::max(distance_m, (extent.high - extent.low) * focal_px / image_px[axis]);
    } else {
      half_depth_m = 0.5F * (extent.high - extent.low);
    }
  }
  const SE3 world_from_camera{rotation, centre - rotation.col(2) * (kMargin * distance_m + half_depth_m)};
  const RenderCamera camera{
      {focal_px, focal_px, 0.5F * (image_px[0] - 1.0F), 0.5F * (image_px[1] - 1.0F)}, width, height, world_from_camera};
  SurfaceMap rendering(volume.context().memory());
  Raycaster(volume.context()).render(volume, camera, rendering, true);
  return apps::shaded_picture(rendering);
}

}  // namespace foothold::replay

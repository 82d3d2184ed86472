// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "view_check.h"

#include <algorithm>
#include <utility>

#include "tile.h"

namespace foothold::synthetic_detail {
namespace {

// (T) by looking at the rooms: nothing fills the view, nothing is out of a depth camera's reach.
constexpr float kClearance_m = 0.4F;
constexpr float kWallClearance_m = 0.2F;
constexpr float kTooNear_m = 0.45F;
constexpr float kNearestMedian_m = 0.8F;
constexpr float kFarthestMedian_m = 3.6F;

/// Half the field of view of a Kinect, as tangents.
constexpr float kHalfWidth = 0.54F;
constexpr float kHalfHeight = 0.4F;
constexpr int kColumns = 5;
constexpr int kRows = 4;
constexpr int kNumRays = kColumns * kRows;

float meet(const PrimitiveView& p, float x, float y) {
  switch (p.shape) {
    case Shape::kRectangle:
      return meet_rectangle(p, x, y);
    case Shape::kBox:
      return meet_box(p, x, y);
    case Shape::kSphere:
      return meet_sphere(p, x, y);
    case Shape::kCylinder:
      return meet_cylinder(p, x, y);
  }
  return kMiss;
}

/// The i-th ray of the grid at depth 1.
Eigen::Vector3f ray_camera(int i) {
  const float column = static_cast<float>(i % kColumns) / (0.5F * (kColumns - 1));
  const float row = static_cast<float>(i / kColumns) / (0.5F * (kRows - 1));
  return {kHalfWidth * (column - 1.0F), kHalfHeight * (row - 1.0F), 1.0F};
}

bool is_clear(const Room& room, const Eigen::Vector3f& eye_world) {
  const bool inside =
      ((eye_world - room.low_world).array() > kWallClearance_m).all() && ((room.high_world - eye_world).array() > kWallClearance_m).all();
  return inside && distance_to_surface(room, eye_world) >= kClearance_m;
}

}  // namespace

std::vector<Eigen::Vector3f> sample_view(const Room& room, const SE3& world_from_camera) {
  std::vector<Eigen::Vector3f> points;
  for (int i = 0; i < kNumRays; ++i) points.push_back(ray_camera(i) * kMiss);
  for (const Primitive& primitive : room.primitives) {
    const PrimitiveView view = view_of(primitive, world_from_camera);
    for (int i = 0; i < kNumRays; ++i) {
      const Eigen::Vector3f ray = ray_camera(i);
      const float t = meet(view, ray.x(), ray.y());
      Eigen::Vector3f& nearest = points[static_cast<std::size_t>(i)];
      if (t < nearest.z()) nearest = ray * t;
    }
  }
  std::sort(points.begin(), points.end(), [](const Eigen::Vector3f& a, const Eigen::Vector3f& b) { return a.z() < b.z(); });
  return points;
}

bool is_good_view(const Room& room, const SE3& world_from_camera, const std::vector<Eigen::Vector3f>& points_camera) {
  if (!is_clear(room, world_from_camera.translation)) return false;
  const float median = points_camera[kNumRays / 2].z();
  return points_camera[1].z() > kTooNear_m && median > kNearestMedian_m && median < kFarthestMedian_m;
}

float share_in_view(const SE3& world_from_camera, const std::vector<Eigen::Vector3f>& points_camera,
                    const std::vector<SE3>& world_from_others) {
  std::vector<SE3> other_from_camera;
  for (const SE3& world_from_other : world_from_others) other_from_camera.push_back(world_from_other.inverse() * world_from_camera);
  const auto seen = std::count_if(points_camera.begin(), points_camera.end(), [&](const Eigen::Vector3f& point_camera) {
    return std::any_of(other_from_camera.begin(), other_from_camera.end(), [&](const SE3& transform) {
      const Eigen::Vector3f p = transform * point_camera;
      return p.z() > kTooNear_m && std::fabs(p.x()) <= kHalfWidth * p.z() && std::fabs(p.y()) <= kHalfHeight * p.z();
    });
  });
  return static_cast<float>(seen) / static_cast<float>(points_camera.size());
}

}  // namespace foothold::synthetic_detail

// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "view_check.h"

#include <algorithm>
#include <vector>

#include "tile.h"

namespace foothold::synthetic_detail {
namespace {

constexpr float kClearance_m = 0.4F;
constexpr float kWall_m = 0.2F;
constexpr float kTooNear_m = 0.45F;
constexpr float kNearestMedian_m = 0.8F;
constexpr float kFarthestMedian_m = 3.6F;

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

}  // namespace

bool is_good_view(const Room& room, const SE3& world_from_camera) {
  const Eigen::Vector3f& eye = world_from_camera.translation;
  const bool inside = ((eye - room.low_world).array() > kWall_m).all() && ((room.high_world - eye).array() > kWall_m).all();
  if (!inside || distance_to_surface(room, eye) < kClearance_m) return false;

  // Depths along a coarse grid of rays over the field of view of a Kinect.
  constexpr int kColumns = 5;
  constexpr int kRows = 4;
  float depths[kColumns * kRows];
  std::fill(std::begin(depths), std::end(depths), kMiss);
  for (const Primitive& primitive : room.primitives) {
    const PrimitiveView view = view_of(primitive, world_from_camera);
    for (int i = 0; i < kColumns * kRows; ++i) {
      const float x = 0.54F * (static_cast<float>(i % kColumns) / 2.0F - 1.0F);
      const float y = 0.4F * (static_cast<float>(i / kColumns) / 1.5F - 1.0F);
      depths[i] = std::min(depths[i], meet(view, x, y));
    }
  }
  std::sort(std::begin(depths), std::end(depths));
  const float median = depths[kColumns * kRows / 2];
  return depths[1] > kTooNear_m && median > kNearestMedian_m && median < kFarthestMedian_m;
}

}  // namespace foothold::synthetic_detail

// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "visibility.h"

#include <algorithm>
#include <array>

namespace foothold::synthetic_detail {
namespace {

using Corners = std::array<Eigen::Vector3f, 8>;

/// The corners of the box around a primitive, in the camera's frame. Corner i differs from corner i ^ 1, i ^ 2 and i ^ 4 along x, y and z.
Corners corners_camera(const Primitive& primitive, const SE3& camera_from_world) {
  Eigen::Vector3f half = primitive.half_size_m;
  if (primitive.shape == Shape::kRectangle) half.z() = 0.0F;
  if (primitive.shape == Shape::kSphere) half.setConstant(half.x());
  if (primitive.shape == Shape::kCylinder) half.y() = half.x();
  const SE3 camera_from_local = camera_from_world * primitive.world_from_local;
  Corners corners;
  for (unsigned i = 0; i < 8; ++i) {
    const Eigen::Vector3f sign((i & 1U) != 0 ? 1.0F : -1.0F, (i & 2U) != 0 ? 1.0F : -1.0F, (i & 4U) != 0 ? 1.0F : -1.0F);
    corners[i] = camera_from_local * half.cwiseProduct(sign);
  }
  return corners;
}

/// The bounds of projected points.
struct Bounds {
  float left = kMiss, top = kMiss, right = -kMiss, bottom = -kMiss;

  void add(const Intrinsics& intrinsics, const Eigen::Vector3f& point_camera) {
    const Eigen::Vector2f pixel = intrinsics.project(point_camera);
    left = std::min(left, pixel.x());
    right = std::max(right, pixel.x());
    top = std::min(top, pixel.y());
    bottom = std::max(bottom, pixel.y());
  }
};

/// Projects the part of the box in front of the camera: corners in front, and where edges pass through the nearest plane.
Bounds project(const Corners& corners, const Intrinsics& intrinsics) {
  Bounds bounds;
  for (unsigned i = 0; i < 8; ++i) {
    const Eigen::Vector3f& a = corners[i];
    if (a.z() >= kNearest) bounds.add(intrinsics, a);
    for (unsigned bit = 1; bit < 8; bit <<= 1U) {
      const Eigen::Vector3f& b = corners[i ^ bit];
      if ((i & bit) != 0 || (a.z() < kNearest) == (b.z() < kNearest)) continue;
      Eigen::Vector3f crossing = a + (b - a) * ((kNearest - a.z()) / (b.z() - a.z()));
      crossing.z() = kNearest;
      bounds.add(intrinsics, crossing);
    }
  }
  return bounds;
}

/// Rounds outwards by a pixel against rounding errors, and cuts to the image.
int to_pixel(float value, float margin, int last) {
  return static_cast<int>(std::clamp(value + margin, -1.0F, static_cast<float>(last) + 1.0F));
}

}  // namespace

std::vector<VisiblePrimitive> visible_primitives(const Room& room, const Intrinsics& intrinsics, const SE3& world_from_camera, int width,
                                                 int height) {
  const SE3 camera_from_world = world_from_camera.inverse();
  std::vector<VisiblePrimitive> result;
  for (std::size_t i = 0; i < room.primitives.size(); ++i) {
    const Corners corners = corners_camera(room.primitives[i], camera_from_world);
    float nearest = kMiss;
    float farthest = -kMiss;
    for (const Eigen::Vector3f& corner : corners) {
      nearest = std::min(nearest, corner.z());
      farthest = std::max(farthest, corner.z());
    }
    if (farthest < kNearest) continue;
    const Bounds bounds = project(corners, intrinsics);
    VisiblePrimitive visible;
    visible.left = std::max(0, to_pixel(bounds.left, -1.0F, width - 1));
    visible.top = std::max(0, to_pixel(bounds.top, -1.0F, height - 1));
    visible.right = std::min(width - 1, to_pixel(bounds.right, 2.0F, width - 1));
    visible.bottom = std::min(height - 1, to_pixel(bounds.bottom, 2.0F, height - 1));
    if (bounds.right < -1.0F || bounds.bottom < -1.0F || visible.left > visible.right || visible.top > visible.bottom) continue;
    visible.index = static_cast<std::int32_t>(i);
    visible.nearest_m = nearest - 1e-4F;
    visible.view = view_of(room.primitives[i], world_from_camera);
    result.push_back(visible);
  }
  std::sort(result.begin(), result.end(), [](const VisiblePrimitive& a, const VisiblePrimitive& b) {
    return a.nearest_m != b.nearest_m ? a.nearest_m < b.nearest_m : a.index < b.index;
  });
  return result;
}

}  // namespace foothold::synthetic_detail

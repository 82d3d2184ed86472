// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// Where a cube may be seen in an image.
#pragma once

#include <Eigen/Core>

#include "foothold/base/camera.h"

namespace foothold {

/// Half the diagonal of a unit cube, rounded up.
inline constexpr float kHalfDiagonal = 0.8661F;

/// The part of the image and the range of depth that a block may cover.
struct BlockExtent {
  int u_min = 0;
  int v_min = 0;
  int u_max = -1;  ///< inclusive; below u_min if the block is out of view
  int v_max = -1;
  float z_near = 0.0F;
  float z_far = 0.0F;

  FOOTHOLD_HD bool visible() const { return u_min <= u_max && v_min <= v_max; }
};

/// Bounds the projection of a cube given by its centre in the camera frame and half its diagonal.
FOOTHOLD_HD inline BlockExtent bound_projection(const Eigen::Vector3f& centre, float radius, const Intrinsics& k, int width, int height) {
  constexpr float kNearestM = 0.05F;  // nothing nearer is seen
  BlockExtent extent;
  extent.z_near = centre.z() - radius > kNearestM ? centre.z() - radius : kNearestM;
  extent.z_far = centre.z() + radius;
  if (extent.z_far < kNearestM) return extent;
  const float inverse_near = 1.0F / extent.z_near;
  const float inverse_far = 1.0F / extent.z_far;
  const float x0 = centre.x() - radius;
  const float x1 = centre.x() + radius;
  const float y0 = centre.y() - radius;
  const float y1 = centre.y() + radius;
  const float u0 = k.fx * x0 * (x0 < 0.0F ? inverse_near : inverse_far) + k.cx;
  const float u1 = k.fx * x1 * (x1 > 0.0F ? inverse_near : inverse_far) + k.cx;
  const float v0 = k.fy * y0 * (y0 < 0.0F ? inverse_near : inverse_far) + k.cy;
  const float v1 = k.fy * y1 * (y1 > 0.0F ? inverse_near : inverse_far) + k.cy;
  const float right = static_cast<float>(width - 1);
  const float bottom = static_cast<float>(height - 1);
  if (u1 < 0.0F || v1 < 0.0F || u0 > right || v0 > bottom) return extent;
  extent.u_min = u0 > 0.0F ? static_cast<int>(u0) : 0;
  extent.v_min = v0 > 0.0F ? static_cast<int>(v0) : 0;
  extent.u_max = u1 < right ? static_cast<int>(u1) + 1 : width - 1;
  extent.v_max = v1 < bottom ? static_cast<int>(v1) + 1 : height - 1;
  return extent;
}

}  // namespace foothold

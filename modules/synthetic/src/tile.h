// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// Rays in square tiles of the image, and their intersection with one primitive at a time: loops that the compiler vectorises.
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <cstdint>
#include <limits>

#include "foothold/base/platform.h"
#include "foothold/base/se3.h"
#include "foothold/synthetic/room.h"

namespace foothold::synthetic_detail {

/// No ray meets anything nearer than this [m].
constexpr float kNearest = 0.01F;
constexpr float kMiss = std::numeric_limits<float>::infinity();

/// A primitive as the camera meets it.
struct PrimitiveView {
  float r[9];  ///< rotation of local_from_camera, row by row
  float o[3];  ///< the camera's centre in the primitive's frame
  float h[3];  ///< half size
  Shape shape;
};

inline PrimitiveView view_of(const Primitive& primitive, const SE3& world_from_camera) {
  const SE3 local_from_camera = primitive.world_from_local.inverse() * world_from_camera;
  PrimitiveView view{};
  for (int i = 0; i < 9; ++i) view.r[i] = local_from_camera.rotation(i / 3, i % 3);
  for (int i = 0; i < 3; ++i) {
    view.o[i] = local_from_camera.translation[i];
    view.h[i] = primitive.half_size_m[i];
  }
  view.shape = primitive.shape;
  return view;
}

/// The ray of camera direction (x, y, 1) in the primitive's frame.
struct LocalRay {
  float dx, dy, dz;
};
FOOTHOLD_INLINE LocalRay local_ray(const PrimitiveView& p, float x, float y) {
  return {p.r[0] * x + p.r[1] * y + p.r[2], p.r[3] * x + p.r[4] * y + p.r[5], p.r[6] * x + p.r[7] * y + p.r[8]};
}

FOOTHOLD_INLINE float lesser(float a, float b) { return a < b ? a : b; }
FOOTHOLD_INLINE float greater(float a, float b) { return a > b ? a : b; }

// Each returns the depth z at which the ray of direction (x, y, 1) enters the primitive, or kMiss.

FOOTHOLD_INLINE float meet_rectangle(const PrimitiveView& p, float x, float y) {
  const LocalRay d = local_ray(p, x, y);
  const float t = -p.o[2] / d.dz;
  const float ax = std::fabs(p.o[0] + t * d.dx);
  const float ay = std::fabs(p.o[1] + t * d.dy);
  const bool hit = (t > kNearest) & (ax <= p.h[0]) & (ay <= p.h[1]);
  return hit ? t : kMiss;
}

FOOTHOLD_INLINE float meet_box(const PrimitiveView& p, float x, float y) {
  const LocalRay d = local_ray(p, x, y);
  const float ix = 1.0F / d.dx;
  const float iy = 1.0F / d.dy;
  const float iz = 1.0F / d.dz;
  const float x0 = (-p.h[0] - p.o[0]) * ix;
  const float x1 = (p.h[0] - p.o[0]) * ix;
  const float y0 = (-p.h[1] - p.o[1]) * iy;
  const float y1 = (p.h[1] - p.o[1]) * iy;
  const float z0 = (-p.h[2] - p.o[2]) * iz;
  const float z1 = (p.h[2] - p.o[2]) * iz;
  const float enter = greater(greater(lesser(x0, x1), lesser(y0, y1)), lesser(z0, z1));
  const float leave = lesser(lesser(greater(x0, x1), greater(y0, y1)), greater(z0, z1));
  const bool hit = (enter <= leave) & (enter > kNearest);
  return hit ? enter : kMiss;
}

/// Measures from the ray's point nearest to the centre, which is accurate even for small far spheres.
FOOTHOLD_INLINE float meet_sphere(const PrimitiveView& p, float x, float y) {
  const LocalRay d = local_ray(p, x, y);
  const float inverse_d2 = 1.0F / (d.dx * d.dx + d.dy * d.dy + d.dz * d.dz);
  const float nearest = -(p.o[0] * d.dx + p.o[1] * d.dy + p.o[2] * d.dz) * inverse_d2;
  const float qx = p.o[0] + nearest * d.dx;
  const float qy = p.o[1] + nearest * d.dy;
  const float qz = p.o[2] + nearest * d.dz;
  const float half_chord2 = p.h[0] * p.h[0] - (qx * qx + qy * qy + qz * qz);
  const float t = nearest - std::sqrt(greater(half_chord2, 0.0F) * inverse_d2);
  const bool hit = (half_chord2 >= 0.0F) & (t > kNearest);
  return hit ? t : kMiss;
}

/// The overlap of the infinite cylinder's interval with that of the slab between the caps.
FOOTHOLD_INLINE float meet_cylinder(const PrimitiveView& p, float x, float y) {
  const LocalRay d = local_ray(p, x, y);
  const float inverse_a = 1.0F / greater(d.dx * d.dx + d.dy * d.dy, 1e-20F);
  const float nearest = -(p.o[0] * d.dx + p.o[1] * d.dy) * inverse_a;
  const float qx = p.o[0] + nearest * d.dx;
  const float qy = p.o[1] + nearest * d.dy;
  const float half_chord2 = p.h[0] * p.h[0] - (qx * qx + qy * qy);
  const float half = std::sqrt(greater(half_chord2, 0.0F) * inverse_a);
  const float iz = 1.0F / d.dz;
  const float z0 = (-p.h[2] - p.o[2]) * iz;
  const float z1 = (p.h[2] - p.o[2]) * iz;
  const float enter = greater(nearest - half, lesser(z0, z1));
  const float leave = lesser(nearest + half, greater(z0, z1));
  const bool hit = (half_chord2 >= 0.0F) & (enter <= leave) & (enter > kNearest);
  return hit ? enter : kMiss;
}

/// A square of pixels with the nearest hit of each ray so far.
struct Tile {
  static constexpr int kSide = 16;
  static constexpr int kSize = kSide * kSide;

  float x[kSize];
  float y[kSize];
  float t[kSize];
  std::int32_t primitive[kSize];

  template <class Meet>
  void trace(const PrimitiveView& view, std::int32_t index, const Meet& meet) {
    const PrimitiveView p = view;
    for (int i = 0; i < kSize; ++i) {
      const float hit = meet(p, x[i], y[i]);
      const bool nearer = hit < t[i];
      t[i] = nearer ? hit : t[i];
      primitive[i] = nearer ? index : primitive[i];
    }
  }

  void trace(const PrimitiveView& view, std::int32_t index) {
    switch (view.shape) {
      case Shape::kRectangle:
        return trace(view, index, [](const PrimitiveView& p, float a, float b) { return meet_rectangle(p, a, b); });
      case Shape::kBox:
        return trace(view, index, [](const PrimitiveView& p, float a, float b) { return meet_box(p, a, b); });
      case Shape::kSphere:
        return trace(view, index, [](const PrimitiveView& p, float a, float b) { return meet_sphere(p, a, b); });
      case Shape::kCylinder:
        return trace(view, index, [](const PrimitiveView& p, float a, float b) { return meet_cylinder(p, a, b); });
    }
  }

  float farthest() const {
    float result = 0.0F;
    for (int i = 0; i < kSize; ++i) result = greater(result, t[i]);
    return result;
  }
};

}  // namespace foothold::synthetic_detail

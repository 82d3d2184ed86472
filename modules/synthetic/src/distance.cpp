// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include <algorithm>
#include <cmath>
#include <limits>

#include "foothold/synthetic/room.h"

namespace foothold {
namespace {

/// Distance from a point to the boundary of a box-like set, given how far each coordinate lies beyond its half size.
template <int N>
float distance_from_excess(const Eigen::Matrix<float, N, 1>& excess) {
  const float inside = excess.maxCoeff();
  return inside <= 0.0F ? -inside : excess.cwiseMax(0.0F).norm();
}

}  // namespace

float distance_to_surface(const Primitive& primitive, const Eigen::Vector3f& point_world) {
  const Eigen::Vector3f p = primitive.world_from_local.inverse() * point_world;
  const Eigen::Vector3f& h = primitive.half_size_m;
  switch (primitive.shape) {
    case Shape::kRectangle: {
      const Eigen::Vector2f beyond = (p.head<2>().cwiseAbs() - h.head<2>()).cwiseMax(0.0F);
      return std::sqrt(beyond.squaredNorm() + p.z() * p.z());
    }
    case Shape::kBox:
      return distance_from_excess<3>(p.cwiseAbs() - h);
    case Shape::kSphere:
      return std::fabs(p.norm() - h.x());
    case Shape::kCylinder:
      return distance_from_excess<2>({p.head<2>().norm() - h.x(), std::fabs(p.z()) - h.z()});
  }
  return std::numeric_limits<float>::infinity();
}

float distance_to_surface(const Room& room, const Eigen::Vector3f& point_world) {
  float nearest = std::numeric_limits<float>::infinity();
  for (const Primitive& primitive : room.primitives) nearest = std::min(nearest, distance_to_surface(primitive, point_world));
  return nearest;
}

}  // namespace foothold

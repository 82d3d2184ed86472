// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// Small rooms for tests.
#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "foothold/base/camera.h"
#include "foothold/base/random.h"
#include "foothold/synthetic/room.h"

namespace foothold::test {

/// A Kinect at a quarter of its resolution.
inline Intrinsics small_camera() { return Intrinsics{585.0F, 585.0F, 320.0F, 240.0F}.scaled(0.25F); }
constexpr int kWidth = 160;
constexpr int kHeight = 120;

inline Primitive primitive(Shape shape, const Eigen::Vector3f& centre, const Eigen::Vector3f& half_size) {
  Primitive result;
  result.shape = shape;
  result.world_from_local.translation = centre;
  result.half_size_m = half_size;
  return result;
}

/// A room of the given primitives only, within [-10, 10]^3.
inline Room bare_room(std::vector<Primitive> primitives) {
  Room room;
  room.primitives = std::move(primitives);
  room.low_world.setConstant(-10.0F);
  room.high_world.setConstant(10.0F);
  return room;
}

inline Eigen::Vector3f random_vector(Random& random, float low, float high) {
  const float x = random.uniform(low, high);
  const float y = random.uniform(low, high);
  return {x, y, random.uniform(low, high)};
}

inline SE3 random_pose(Random& random, float spread_m) {
  Tangent6 tangent;
  tangent.head<3>() = random_vector(random, -1.7F, 1.7F);
  tangent.tail<3>().setZero();
  SE3 pose = se3_exp(tangent);
  pose.rotation = nearest_rotation(pose.rotation);
  pose.translation = random_vector(random, -spread_m, spread_m);
  return pose;
}

/// Any of the four shapes, anywhere.
inline Primitive random_primitive(Random& random, float spread_m) {
  Primitive result;
  result.shape = static_cast<Shape>(random.below(4));
  result.world_from_local = random_pose(random, spread_m);
  result.half_size_m = random_vector(random, 0.05F, 0.6F);
  return result;
}

}  // namespace foothold::test

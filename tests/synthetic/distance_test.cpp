// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include <cmath>

#include "scenes.h"
#include "support/catch.h"
#include "support/random_seed.h"

namespace foothold {
namespace {

using Eigen::Vector3f;
using test::primitive;

constexpr float kDistanceTolerance_m = 1e-5F;

float distance(Shape shape, const Vector3f& half_size, const Vector3f& point) {
  return distance_to_surface(primitive(shape, Vector3f::Zero(), half_size), point);
}

TEST_CASE("distance_to_surface: a box from its faces, edges, corners and inside") {
  const Vector3f half(1.0F, 2.0F, 3.0F);
  REQUIRE(distance(Shape::kBox, half, {1.5F, 0.0F, 0.0F}) == Approx(0.5F).margin(kDistanceTolerance_m));
  REQUIRE(distance(Shape::kBox, half, {4.0F, 6.0F, 0.0F}) == Approx(5.0F).margin(kDistanceTolerance_m));
  REQUIRE(distance(Shape::kBox, half, {2.0F, 4.0F, 5.0F}) == Approx(3.0F).margin(kDistanceTolerance_m));
  REQUIRE(distance(Shape::kBox, half, {0.2F, 0.0F, 0.0F}) == Approx(0.8F).margin(kDistanceTolerance_m));
}

TEST_CASE("distance_to_surface: a rectangle from both sides and beyond its rim") {
  const Vector3f half(1.0F, 2.0F, 0.0F);
  REQUIRE(distance(Shape::kRectangle, half, {0.5F, -1.0F, 0.3F}) == Approx(0.3F).margin(kDistanceTolerance_m));
  REQUIRE(distance(Shape::kRectangle, half, {0.5F, -1.0F, -0.3F}) == Approx(0.3F).margin(kDistanceTolerance_m));
  REQUIRE(distance(Shape::kRectangle, half, {2.0F, 4.0F, 2.0F}) == Approx(3.0F).margin(kDistanceTolerance_m));
}

TEST_CASE("distance_to_surface: a sphere and a cylinder on both sides") {
  REQUIRE(distance(Shape::kSphere, Vector3f::Constant(0.5F), {0.0F, 0.0F, 2.0F}) == Approx(1.5F).margin(kDistanceTolerance_m));
  REQUIRE(distance(Shape::kSphere, Vector3f::Constant(0.5F), {0.1F, 0.0F, 0.0F}) == Approx(0.4F).margin(kDistanceTolerance_m));
  const Vector3f half(0.5F, 0.5F, 1.0F);
  REQUIRE(distance(Shape::kCylinder, half, {2.0F, 0.0F, 0.5F}) == Approx(1.5F).margin(kDistanceTolerance_m));
  REQUIRE(distance(Shape::kCylinder, half, {0.1F, 0.0F, -3.0F}) == Approx(2.0F).margin(kDistanceTolerance_m));
  REQUIRE(distance(Shape::kCylinder, half, {3.5F, 0.0F, 5.0F}) == Approx(5.0F).margin(kDistanceTolerance_m));
  REQUIRE(distance(Shape::kCylinder, half, {0.0F, 0.0F, 0.9F}) == Approx(0.1F).margin(kDistanceTolerance_m));
}

TEST_CASE("distance_to_surface: never larger than the distance to any point of the surface, and reached by one") {
  // Sampling a surface every few millimetres finds its nearest point to about that.
  constexpr int kSteps = 120;
  Random random = test::test_random();
  for (int i = 0; i < 30; ++i) {
    Primitive box = test::random_primitive(random, 1.0F);
    box.shape = Shape::kBox;
    const Vector3f point = test::random_vector(random, -2.0F, 2.0F);
    const float actual = distance_to_surface(box, point);
    float sampled = 1e9F;
    for (int axis = 0; axis < 3; ++axis) {
      for (int a = 0; a <= kSteps; ++a) {
        for (int b = 0; b <= kSteps; ++b) {
          Vector3f local;
          local[(axis + 1) % 3] = box.half_size_m[(axis + 1) % 3] * (2.0F * static_cast<float>(a) / kSteps - 1.0F);
          local[(axis + 2) % 3] = box.half_size_m[(axis + 2) % 3] * (2.0F * static_cast<float>(b) / kSteps - 1.0F);
          for (const float side : {-1.0F, 1.0F}) {
            local[axis] = side * box.half_size_m[axis];
            sampled = std::min(sampled, (box.world_from_local * local - point).norm());
          }
        }
      }
    }
    REQUIRE(actual <= sampled + kDistanceTolerance_m);
    REQUIRE(actual >= sampled - 0.01F);
  }
}

TEST_CASE("distance_to_surface: a room's is that of its nearest primitive, and an empty room has none") {
  const Room room = test::bare_room(
      {primitive(Shape::kSphere, {0.0F, 0.0F, 0.0F}, Vector3f::Ones()), primitive(Shape::kSphere, {5.0F, 0.0F, 0.0F}, Vector3f::Ones())});
  REQUIRE(distance_to_surface(room, {3.0F, 0.0F, 0.0F}) == Approx(1.0F).margin(kDistanceTolerance_m));
  REQUIRE(distance_to_surface(room, {1.5F, 0.0F, 0.0F}) == Approx(0.5F).margin(kDistanceTolerance_m));
  REQUIRE(std::isinf(distance_to_surface(test::bare_room({}), Vector3f::Zero())));
}

}  // namespace
}  // namespace foothold

// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "foothold/base/camera.h"

#include <limits>

#include "support/catch.h"
#include "support/random_seed.h"

namespace foothold {
namespace {

/// A few roundings of pixel coordinates below 1000.
constexpr float kTolerance_px = 1e-3F;

const Intrinsics kKinect{585.0F, 580.0F, 320.5F, 239.0F};

TEST_CASE("Intrinsics: project inverts back_project") {
  Random random = test::test_random();
  for (int i = 0; i < 1000; ++i) {
    const float u = random.uniform(-100.0F, 740.0F);
    const float v = random.uniform(-100.0F, 580.0F);
    const float depth_m = random.uniform(0.1F, 20.0F);
    const Eigen::Vector3f point_camera = kKinect.back_project(u, v, depth_m);
    REQUIRE(point_camera.z() == depth_m);
    REQUIRE((kKinect.project(point_camera) - Eigen::Vector2f(u, v)).norm() < kTolerance_px);
  }
}

TEST_CASE("Intrinsics: x points right, y down, z forward, and the principal point lies on the axis") {
  REQUIRE(kKinect.back_project(kKinect.cx, kKinect.cy, 2.0F) == Eigen::Vector3f(0.0F, 0.0F, 2.0F));
  REQUIRE(kKinect.back_project(kKinect.cx + 1.0F, kKinect.cy, 2.0F).x() > 0.0F);
  REQUIRE(kKinect.back_project(kKinect.cx, kKinect.cy + 1.0F, 2.0F).y() > 0.0F);
}

TEST_CASE("Intrinsics: scaling keeps every point in its place of the resized image") {
  Random random = test::test_random();
  for (const float factor : {0.25F, 0.5F, 2.0F}) {
    const Intrinsics scaled = kKinect.scaled(factor);
    for (int i = 0; i < 100; ++i) {
      const Eigen::Vector3f point_camera(random.uniform(-1.0F, 1.0F), random.uniform(-1.0F, 1.0F), random.uniform(0.5F, 4.0F));
      const Eigen::Vector2f pixel = kKinect.project(point_camera);
      // The image's edge, half a pixel left of the first centre, stays the edge.
      const Eigen::Vector2f expected = (pixel.array() + 0.5F) * factor - 0.5F;
      REQUIRE((scaled.project(point_camera) - expected).norm() < kTolerance_px * factor);
    }
  }
}

TEST_CASE("is_valid: wants positive focal lengths and finite values") {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  REQUIRE(is_valid(kKinect));
  REQUIRE(is_valid(Intrinsics{500.0F, 500.0F, -10.0F, 0.0F}));
  REQUIRE_FALSE(is_valid(Intrinsics{}));
  REQUIRE_FALSE(is_valid(Intrinsics{-500.0F, 500.0F, 320.0F, 240.0F}));
  REQUIRE_FALSE(is_valid(Intrinsics{500.0F, 500.0F, nan, 240.0F}));
  REQUIRE_FALSE(is_valid(Intrinsics{500.0F, std::numeric_limits<float>::infinity(), 320.0F, 240.0F}));
}

TEST_CASE("is_valid_depth: zero, negative, infinite and NaN mean no measurement") {
  REQUIRE(is_valid_depth(0.001F));
  REQUIRE(is_valid_depth(9.0F));
  for (const float hole : {0.0F, -0.0F, -1.0F, std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()}) {
    REQUIRE_FALSE(is_valid_depth(hole));
  }
}

}  // namespace
}  // namespace foothold

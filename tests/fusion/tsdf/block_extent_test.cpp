// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "tsdf/block_extent.h"

#include "foothold/base/random.h"
#include "support/catch.h"
#include "support/random_seed.h"

namespace foothold {
namespace {

constexpr Intrinsics kCamera{150.0F, 140.0F, 79.5F, 59.5F};
constexpr int kWidth = 160;
constexpr int kHeight = 120;
constexpr float kNearestM = 0.05F;

TEST_CASE("bound_projection: whatever is seen of a sphere is seen within its bounds, across the camera's plane, too") {
  Random random = test::test_random();
  const auto between = [&](float low, float high) { return low + (high - low) * random.uniform(); };
  int num_seen = 0;
  for (int round = 0; round < 3000; ++round) {
    const float radius = between(0.02F, 0.3F);
    const Eigen::Vector3f centre(between(-1.0F, 1.0F), between(-1.0F, 1.0F), between(-0.4F, 1.5F));
    const BlockExtent extent = bound_projection(centre, radius, kCamera, kWidth, kHeight);
    for (int i = 0; i < 20; ++i) {
      const Eigen::Vector3f direction(between(-1.0F, 1.0F), between(-1.0F, 1.0F), between(-1.0F, 1.0F));
      const Eigen::Vector3f point = centre + radius * between(0.0F, 1.0F) * direction.normalized();
      if (point.z() < kNearestM) continue;
      const Eigen::Vector2f pixel = kCamera.project(point);
      if (!(pixel.x() >= 0.0F && pixel.y() >= 0.0F && pixel.x() <= kWidth - 1 && pixel.y() <= kHeight - 1)) continue;
      ++num_seen;
      REQUIRE(extent.visible());
      REQUIRE(pixel.x() >= static_cast<float>(extent.u_min));
      REQUIRE(pixel.x() <= static_cast<float>(extent.u_max));
      REQUIRE(pixel.y() >= static_cast<float>(extent.v_min));
      REQUIRE(pixel.y() <= static_cast<float>(extent.v_max));
      REQUIRE(point.z() >= extent.z_near - 1e-5F);
      REQUIRE(point.z() <= extent.z_far + 1e-5F);
    }
  }
  REQUIRE(num_seen > 1000);
}

TEST_CASE("bound_projection: what lies beside the camera, across its plane, is out of view") {
  for (const float side : {-1.0F, 1.0F}) {
    REQUIRE_FALSE(bound_projection({2.0F * side, 0.0F, 0.0F}, 0.1F, kCamera, kWidth, kHeight).visible());
    REQUIRE_FALSE(bound_projection({0.0F, 2.0F * side, 0.03F}, 0.1F, kCamera, kWidth, kHeight).visible());
  }
  REQUIRE_FALSE(bound_projection({0.0F, 0.0F, -0.2F}, 0.1F, kCamera, kWidth, kHeight).visible());
  REQUIRE(bound_projection({0.0F, 0.0F, 0.0F}, 0.1F, kCamera, kWidth, kHeight).visible());
}

}  // namespace
}  // namespace foothold

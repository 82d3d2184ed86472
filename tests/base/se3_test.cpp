// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "foothold/base/se3.h"

#include "support/catch.h"
#include "support/random_seed.h"

namespace foothold {
namespace {

/// Single precision over a handful of products.
constexpr float kTolerance = 2e-5F;

Tangent6 random_tangent(Random& random, float scale) {
  Tangent6 tangent;
  for (int i = 0; i < 6; ++i) tangent[i] = random.uniform(-scale, scale);
  return tangent;
}

TEST_CASE("se3_exp: is inverted by se3_log") {
  Random random = test::test_random();
  for (const float scale : {1e-6F, 1e-3F, 1.0F, 1.7F}) {
    for (int i = 0; i < 50; ++i) {
      const Tangent6 tangent = random_tangent(random, scale);
      REQUIRE((se3_log(se3_exp(tangent)) - tangent).norm() < kTolerance);
    }
  }
}

TEST_CASE("SE3: composition with the inverse is the identity") {
  Random random = test::test_random();
  for (int i = 0; i < 50; ++i) {
    const SE3 a = se3_exp(random_tangent(random, 1.5F));
    const SE3 identity = a * a.inverse();
    REQUIRE(rotation_distance_rad(identity, SE3{}) < kTolerance);
    REQUIRE(translation_distance_m(identity, SE3{}) < kTolerance);
  }
}

TEST_CASE("rotation_distance_rad: reads tiny and large angles correctly") {
  for (const float angle : {0.0F, 1e-4F, 0.1F, 3.0F}) {
    Tangent6 tangent = Tangent6::Zero();
    tangent[1] = angle;
    REQUIRE(std::abs(rotation_distance_rad(se3_exp(tangent), SE3{}) - angle) < kTolerance + angle * 1e-3F);
  }
}

}  // namespace
}  // namespace foothold

// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "foothold/evaluation/pose_error.h"

#include <limits>

#include "support/catch.h"
#include "support/random_seed.h"

namespace foothold {
namespace {

constexpr double kRadPerDeg = 0.017453292519943295;
/// Single precision poses of a few metres.
constexpr double kErrorTolerance = 1e-5;

TEST_CASE("pose_error: is what a pose was displaced by, wherever it is") {
  Random random = test::test_random();
  for (int trial = 0; trial < 20; ++trial) {
    Tangent6 pose;
    for (int i = 0; i < 6; ++i) pose[i] = random.uniform(-1.0F, 1.0F);
    const float distance_m = random.uniform(0.0F, 0.5F);
    const float angle_rad = random.uniform(0.0F, 1.0F);
    SE3 displaced = se3_exp(pose);
    displaced.rotation = displaced.rotation * se3_exp((Tangent6() << 0, angle_rad, 0, 0, 0, 0).finished()).rotation;
    displaced.translation += displaced.rotation * Eigen::Vector3f(0, 0, distance_m);
    const PoseError error = pose_error(displaced, se3_exp(pose));
    REQUIRE(error.translation_m == Approx(distance_m).margin(kErrorTolerance));
    REQUIRE(error.rotation_rad == Approx(angle_rad).margin(kErrorTolerance));
  }
}

TEST_CASE("PoseThreshold: both limits must hold, each inclusive") {
  const PoseThreshold threshold{0.05, 5.0};
  REQUIRE(threshold.contains({0.0, 0.0}));
  REQUIRE(threshold.contains({0.05, 5.0 * kRadPerDeg}));
  REQUIRE_FALSE(threshold.contains({0.0501, 0.0}));
  REQUIRE_FALSE(threshold.contains({0.0, 5.01 * kRadPerDeg}));
  REQUIRE_FALSE(threshold.contains({std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()}));
  REQUIRE_FALSE(threshold.contains({std::numeric_limits<double>::quiet_NaN(), 0.0}));
}

TEST_CASE("recall_ladder: keys are those of the JSON interface") {
  std::vector<std::string> keys;
  for (const PoseThreshold& threshold : recall_ladder()) keys.push_back(threshold.key());
  REQUIRE(keys == std::vector<std::string>{"1cm_1deg", "2cm_2deg", "5cm_5deg", "10cm_10deg"});
}

}  // namespace
}  // namespace foothold

// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "foothold/base/se3.h"

#include <Eigen/Geometry>
#include <limits>

#include "support/catch.h"
#include "support/error_message.h"
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

TEST_CASE("is_near: both distance and angle must be small") {
  const SE3 pose = se3_exp((Tangent6() << 0.2F, -0.1F, 0.3F, 1.0F, 2.0F, -1.0F).finished());
  const SE3 moved = se3_exp((Tangent6() << 0.0F, 0.0F, 0.0F, 0.0F, 0.04F, 0.0F).finished()) * pose;
  SE3 turned = pose;
  turned.rotation = se3_exp((Tangent6() << 0.0F, 0.05F, 0.0F, 0.0F, 0.0F, 0.0F).finished()).rotation * pose.rotation;
  REQUIRE(is_near(pose, moved, 0.05F, 1.0F));
  REQUIRE_FALSE(is_near(pose, moved, 0.03F, 1.0F));
  REQUIRE(is_near(pose, turned, 0.01F, 3.0F));  // 0.05 rad are 2.9 deg
  REQUIRE_FALSE(is_near(pose, turned, 0.01F, 2.5F));
}

TEST_CASE("rotation_distance_rad: reads tiny and large angles correctly") {
  for (const float angle : {0.0F, 1e-4F, 0.1F, 3.0F}) {
    Tangent6 tangent = Tangent6::Zero();
    tangent[1] = angle;
    REQUIRE(std::abs(rotation_distance_rad(se3_exp(tangent), SE3{}) - angle) < kTolerance + angle * 1e-3F);
  }
}

TEST_CASE("se3_log: is inverted by se3_exp up to half a turn") {
  for (const float angle : {1.0F, 2.5F, 3.1F, 3.14F}) {
    Tangent6 tangent = Tangent6::Zero();
    tangent.head<3>() = angle * Eigen::Vector3f(0.6F, -0.64F, 0.48F);
    tangent.tail<3>() = Eigen::Vector3f(0.3F, 1.0F, -2.0F);
    const SE3 transform = se3_exp(tangent);
    REQUIRE(rotation_distance_rad(se3_exp(se3_log(transform)), transform) < 1e-3F);  // the angle is ill-conditioned near half a turn
    REQUIRE(translation_distance_m(se3_exp(se3_log(transform)), transform) < 1e-3F);
  }
}

TEST_CASE("se3_exp: moves a point by rotation x point + translation, to first order") {
  Random random = test::test_random();
  constexpr float kStep = 1e-3F;
  for (int i = 0; i < 50; ++i) {
    const Tangent6 twist = random_tangent(random, 1.0F);
    const Eigen::Vector3f point(random.uniform(-2.0F, 2.0F), random.uniform(-2.0F, 2.0F), random.uniform(-2.0F, 2.0F));
    const Eigen::Vector3f omega = twist.head<3>();
    const Eigen::Vector3f velocity = omega.cross(point) + twist.tail<3>();
    // A central difference, whose error is of second order in the step and of rounding over the step.
    const Eigen::Vector3f difference = (se3_exp(kStep * twist) * point - se3_exp(-kStep * twist) * point) / (2.0F * kStep);
    REQUIRE((difference - velocity).norm() < 2e-3F);
  }
}

TEST_CASE("skew: multiplies like the cross product") {
  const Eigen::Vector3f a(1.0F, -2.0F, 3.0F);
  const Eigen::Vector3f b(0.5F, 4.0F, -1.0F);
  REQUIRE((skew(a) * b - a.cross(b)).norm() < kTolerance);
}

TEST_CASE("SE3: chains map points like their parts") {
  Random random = test::test_random();
  const SE3 world_from_camera = se3_exp(random_tangent(random, 1.0F));
  const SE3 camera_from_imu = se3_exp(random_tangent(random, 1.0F));
  const Eigen::Vector3f point_imu(0.1F, 0.2F, 0.3F);
  REQUIRE(((world_from_camera * camera_from_imu) * point_imu - world_from_camera * (camera_from_imu * point_imu)).norm() < kTolerance);
}

TEST_CASE("nearest_rotation: repairs a rotation that was scaled, sheared a little, or rounded") {
  Random random = test::test_random();
  for (int i = 0; i < 50; ++i) {
    const Eigen::Matrix3f rotation = se3_exp(random_tangent(random, 1.5F)).rotation;
    REQUIRE((nearest_rotation(1.7F * rotation) - rotation).norm() < kTolerance);
    Eigen::Matrix3f disturbed = rotation;
    for (int k = 0; k < 9; ++k) disturbed(k / 3, k % 3) += random.uniform(-1e-3F, 1e-3F);
    const Eigen::Matrix3f repaired = nearest_rotation(disturbed);
    REQUIRE(is_rigid(SE3{repaired, Eigen::Vector3f::Zero()}, 1e-6F));
    REQUIRE((repaired - disturbed).norm() <= (rotation - disturbed).norm() + kTolerance);
  }
}

TEST_CASE("is_rigid: refuses what is sheared, mirrored or not finite") {
  SE3 transform;
  REQUIRE(is_rigid(transform, 0.0F));
  transform.rotation(0, 1) = 1e-2F;
  REQUIRE(is_rigid(transform, 2e-2F));
  REQUIRE_FALSE(is_rigid(transform, 1e-3F));
  transform = SE3{};
  transform.rotation(2, 2) = -1.0F;
  REQUIRE_FALSE(is_rigid(transform, 1e-3F));
  transform = SE3{};
  transform.rotation(1, 1) = std::numeric_limits<float>::quiet_NaN();
  REQUIRE_FALSE(is_rigid(transform, 1e-3F));
  transform = SE3{};
  transform.translation.z() = std::numeric_limits<float>::infinity();
  REQUIRE_FALSE(is_rigid(transform, 1e-3F));
}

TEST_CASE("describe_pose_error: names what is wrong with a pose, and with a rigid one nothing") {
  SE3 pose = se3_exp((Tangent6() << 0.3F, -1.0F, 0.5F, 1.0F, 2.0F, 3.0F).finished());
  CHECK(describe_pose_error(pose).empty());
  const auto with_rotation = [&](const Eigen::Matrix3f& factor) { return describe_pose_error({pose.rotation * factor, pose.translation}); };
  CHECK(test::contains(with_rotation(Eigen::Vector3f(1.0F, 1.0F, -1.0F).asDiagonal()), "mirrors"));
  CHECK(test::contains(with_rotation(1.05F * Eigen::Matrix3f::Identity()), "scales"));
  CHECK(test::contains(with_rotation(1000.0F * Eigen::Matrix3f::Identity()), "scales"));
  Eigen::Matrix3f shear = Eigen::Matrix3f::Identity();
  shear(0, 1) = 0.05F;
  CHECK(test::contains(with_rotation(shear), "shears"));
  CHECK(test::contains(with_rotation(Eigen::Matrix3f::Constant(std::nanf(""))), "rotation is not finite"));
  CHECK(!with_rotation(Eigen::Matrix3f::Zero()).empty());
  pose.translation.x() = INFINITY;
  CHECK(test::contains(describe_pose_error(pose), "translation is not finite"));
}

}  // namespace
}  // namespace foothold

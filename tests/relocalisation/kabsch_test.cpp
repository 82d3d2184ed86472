// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "pose/kabsch.h"

#include <Eigen/Geometry>
#include <Eigen/SVD>

#include "support/catch.h"
#include "support/random_motion.h"
#include "support/random_seed.h"

namespace foothold {
namespace {

/// Single precision on coordinates of a few metres.
constexpr double kKabschTolerance = 2e-5;

Eigen::Vector3f random_point(Random& random) {
  return {random.uniform(-3.0F, 3.0F), random.uniform(-3.0F, 3.0F), random.uniform(-3.0F, 3.0F)};
}

SE3 random_pose(Random& random) { return test::random_motion(random, 1.8F, 1.8F); }

/// Height of a triangle over its first edge and that edge's length, the smaller [m].
float thickness(const Eigen::Vector3f* p) {
  const float length = (p[1] - p[0]).norm();
  return std::min(length, (p[1] - p[0]).cross(p[2] - p[0]).norm() / length);
}

/// Kabsch's solution by singular value decomposition, in double precision.
void kabsch(const Eigen::Vector3f* source, const Eigen::Vector3f* target, Eigen::Matrix3d& rotation, Eigen::Vector3d& translation) {
  Eigen::Matrix3d s;
  Eigen::Matrix3d t;
  for (int i = 0; i < 3; ++i) {
    s.col(i) = source[i].cast<double>();
    t.col(i) = target[i].cast<double>();
  }
  const Eigen::Vector3d s_mean = s.rowwise().mean();
  const Eigen::Vector3d t_mean = t.rowwise().mean();
  const Eigen::Matrix3d covariance = (t.colwise() - t_mean) * (s.colwise() - s_mean).transpose();
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(covariance, Eigen::ComputeFullU | Eigen::ComputeFullV);
  Eigen::Vector3d signs(1.0, 1.0, (svd.matrixU() * svd.matrixV().transpose()).determinant() < 0.0 ? -1.0 : 1.0);
  rotation = svd.matrixU() * signs.asDiagonal() * svd.matrixV().transpose();
  translation = t_mean - rotation * s_mean;
}

TEST_CASE("fit_rigid_to_triple: recovers a transform from exact pairs") {
  Random random = test::test_random();
  for (int repeat = 0; repeat < 1000; ++repeat) {
    const Eigen::Vector3f source[3] = {random_point(random), random_point(random), random_point(random)};
    if (thickness(source) < 0.3F) continue;
    const SE3 truth = random_pose(random);
    const Eigen::Vector3f target[3] = {truth * source[0], truth * source[1], truth * source[2]};
    SE3 found;
    REQUIRE(fit_rigid_to_triple(source, target, found));
    REQUIRE((found.rotation - truth.rotation).norm() < kKabschTolerance);
    REQUIRE((found.translation - truth.translation).norm() < 5 * kKabschTolerance);
    REQUIRE(is_rigid(found, 1e-5F));
  }
}

TEST_CASE("fit_rigid_to_triple: is Kabsch's solution for noisy triples") {
  Random random = test::test_random();
  int num_compared = 0;
  for (int repeat = 0; repeat < 2000; ++repeat) {
    const Eigen::Vector3f source[3] = {random_point(random), random_point(random), random_point(random)};
    const SE3 truth = random_pose(random);
    Eigen::Vector3f target[3];
    for (int i = 0; i < 3; ++i) target[i] = truth * source[i] + 0.02F * random_point(random);  // up to 6 cm on each axis
    if (thickness(source) < 0.3F || thickness(target) < 0.3F) continue;
    SE3 found;
    REQUIRE(fit_rigid_to_triple(source, target, found));
    Eigen::Matrix3d rotation;
    Eigen::Vector3d translation;
    kabsch(source, target, rotation, translation);
    REQUIRE((found.rotation.cast<double>() - rotation).norm() < 5 * kKabschTolerance);
    REQUIRE((found.translation.cast<double>() - translation).norm() < 20 * kKabschTolerance);
    ++num_compared;
  }
  REQUIRE(num_compared > 1000);
}

TEST_CASE("fit_rigid_to_triple: refuses degenerate triples and leaves the result alone") {
  const Eigen::Vector3f good[3] = {{0.0F, 0.0F, 1.0F}, {1.0F, 0.0F, 1.0F}, {0.0F, 1.0F, 1.5F}};
  const Eigen::Vector3f nan(std::nanf(""), 0.0F, 0.0F);
  const Eigen::Vector3f degenerate[][3] = {
      {{0.0F, 0.0F, 1.0F}, {1.0F, 0.0F, 1.0F}, {2.0F, 0.0F, 1.0F}},    // on a line
      {{0.0F, 0.0F, 1.0F}, {1.0F, 0.0F, 1.0F}, {0.5F, 0.019F, 1.0F}},  // 19 mm from a line
      {{0.0F, 0.0F, 1.0F}, {0.0F, 0.0F, 1.0F}, {1.0F, 1.0F, 1.0F}},    // two alike
      {{0.0F, 0.0F, 1.0F}, {1.0F, 0.0F, 1.0F}, {1.0F, 0.0F, 1.0F}},    // two others
      {{1.0F, 2.0F, 3.0F}, {1.0F, 2.0F, 3.0F}, {1.0F, 2.0F, 3.0F}},    // all alike
      {{0.0F, 0.0F, 1.0F}, nan, {1.0F, 1.0F, 1.0F}},
  };
  SE3 untouched;
  untouched.translation = {7.0F, 8.0F, 9.0F};
  SE3 result = untouched;
  for (const auto& triple : degenerate) {
    REQUIRE_FALSE(fit_rigid_to_triple(triple, good, result));
    REQUIRE_FALSE(fit_rigid_to_triple(good, triple, result));
    REQUIRE(result.translation == untouched.translation);
    REQUIRE(result.rotation == untouched.rotation);
  }
  REQUIRE(fit_rigid_to_triple(good, good, result));
}

}  // namespace
}  // namespace foothold

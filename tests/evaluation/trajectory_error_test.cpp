// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "foothold/evaluation/trajectory_error.h"

#include <cmath>
#include <vector>

#include "foothold/base/error.h"
#include "support/catch.h"
#include "support/random_motion.h"
#include "support/random_seed.h"

namespace foothold {
namespace {

/// Single-precision poses of a few metres.
constexpr double kTrajectoryTolerance = 2e-5;

/// With `scale` in radians and metres.
SE3 random_pose(Random& random, float scale) { return test::random_motion(random, scale, scale); }

std::vector<SE3> random_trajectory(Random& random, int num_poses) {
  std::vector<SE3> poses = {random_pose(random, 1.0F)};
  while (static_cast<int>(poses.size()) < num_poses) poses.push_back(poses.back() * random_pose(random, 0.1F));
  return poses;
}

std::vector<SE3> moved(const SE3& target_from_source, const std::vector<SE3>& poses) {
  std::vector<SE3> result;
  for (const SE3& pose : poses) result.push_back(target_from_source * pose);
  return result;
}

/// RMSE after a rigid transform, in double precision.
double rmse_under(const SE3& transform, const std::vector<SE3>& estimated, const std::vector<SE3>& truth) {
  double sum = 0.0;
  for (std::size_t i = 0; i < truth.size(); ++i)
    sum += ((transform * estimated[i].translation) - truth[i].translation).cast<double>().squaredNorm();
  return std::sqrt(sum / static_cast<double>(truth.size()));
}

TEST_CASE("absolute_trajectory_error: a rigidly moved trajectory has no error once aligned, its full error otherwise") {
  Random random = test::test_random();
  const std::vector<SE3> truth = random_trajectory(random, 50);
  const SE3 estimate_from_truth = random_pose(random, 1.0F);
  const std::vector<SE3> estimated = moved(estimate_from_truth, truth);
  const AbsoluteTrajectoryError aligned = absolute_trajectory_error(estimated, truth, TrajectoryAlignment::kRigid);
  REQUIRE(aligned.rmse_m < kTrajectoryTolerance);
  REQUIRE(aligned.max_m < kTrajectoryTolerance);
  REQUIRE(translation_distance_m(aligned.truth_from_estimate * estimate_from_truth, SE3{}) < kTrajectoryTolerance);
  REQUIRE(rotation_distance_rad(aligned.truth_from_estimate * estimate_from_truth, SE3{}) < kTrajectoryTolerance);
  const AbsoluteTrajectoryError raw = absolute_trajectory_error(estimated, truth, TrajectoryAlignment::kNone);
  REQUIRE(raw.rmse_m == Approx(rmse_under(SE3{}, estimated, truth)).margin(kTrajectoryTolerance));
}

TEST_CASE("absolute_trajectory_error: a constant offset is that offset in every statistic") {
  Random random = test::test_random();
  const std::vector<SE3> truth = random_trajectory(random, 20);
  SE3 shift;
  shift.translation = {0.3F, 0.0F, -0.4F};
  const AbsoluteTrajectoryError error = absolute_trajectory_error(moved(shift, truth), truth, TrajectoryAlignment::kNone);
  for (const double value : {error.rmse_m, error.mean_m, error.median_m, error.max_m})
    REQUIRE(value == Approx(0.5).margin(kTrajectoryTolerance));
}

TEST_CASE("absolute_trajectory_error: no nearby transform aligns noisy positions better") {
  Random random = test::test_random();
  const std::vector<SE3> truth = random_trajectory(random, 40);
  std::vector<SE3> estimated = moved(random_pose(random, 1.0F), truth);
  for (SE3& pose : estimated)
    pose.translation += Eigen::Vector3f(random.uniform(-0.05F, 0.05F), random.uniform(-0.05F, 0.05F), random.uniform(-0.05F, 0.05F));
  const AbsoluteTrajectoryError best = absolute_trajectory_error(estimated, truth, TrajectoryAlignment::kRigid);
  REQUIRE(is_rigid(best.truth_from_estimate, 1e-5F));
  for (int trial = 0; trial < 200; ++trial) {
    REQUIRE(rmse_under(random_pose(random, 0.02F) * best.truth_from_estimate, estimated, truth) > best.rmse_m - kTrajectoryTolerance);
  }
}

TEST_CASE("absolute_trajectory_error: aligning never mirrors, even a planar trajectory") {
  std::vector<SE3> truth(4);
  std::vector<SE3> estimated(4);
  const float corners[4][2] = {{0, 0}, {1, 0}, {1, 2}, {0, 2}};
  for (int i = 0; i < 4; ++i) {
    truth[i].translation = {corners[i][0], corners[i][1], 0.0F};
    estimated[i].translation = {-corners[i][0], corners[i][1], 0.0F};  // a mirror image, which a half turn about y undoes
  }
  const AbsoluteTrajectoryError error = absolute_trajectory_error(estimated, truth, TrajectoryAlignment::kRigid);
  REQUIRE(error.rmse_m < kTrajectoryTolerance);
  REQUIRE(is_rigid(error.truth_from_estimate, 1e-5F));
}

TEST_CASE("absolute_trajectory_error: a single pose aligns exactly, and none, or unequal numbers, break the contract") {
  Random random = test::test_random();
  const std::vector<SE3> one = {random_pose(random, 1.0F)};
  REQUIRE(absolute_trajectory_error(one, std::vector<SE3>(1), TrajectoryAlignment::kRigid).rmse_m < kTrajectoryTolerance);
  REQUIRE_THROWS_AS(absolute_trajectory_error(std::vector<SE3>{}, std::vector<SE3>{}, TrajectoryAlignment::kNone), ContractViolation);
  REQUIRE_THROWS_AS(absolute_trajectory_error(one, std::vector<SE3>(2), TrajectoryAlignment::kNone), ContractViolation);
}

TEST_CASE("relative_pose_error: does not see a rigid motion of the whole, sees constant drift exactly") {
  Random random = test::test_random();
  const std::vector<SE3> truth = random_trajectory(random, 30);
  const RelativePoseError none = relative_pose_error(moved(random_pose(random, 1.0F), truth), truth, 5);
  REQUIRE(none.num_pairs == 25);
  REQUIRE(none.translation_rmse_m < kTrajectoryTolerance);
  REQUIRE(none.rotation_rmse_rad < 1e-4);

  std::vector<SE3> drifting(10);
  for (int i = 0; i < 10; ++i) drifting[static_cast<std::size_t>(i)].translation.x() = 0.01F * static_cast<float>(i);
  const RelativePoseError drift = relative_pose_error(drifting, std::vector<SE3>(10), 3);
  REQUIRE(drift.num_pairs == 7);
  REQUIRE(drift.translation_rmse_m == Approx(0.03).margin(kTrajectoryTolerance));
  REQUIRE(relative_pose_error(drifting, std::vector<SE3>(10), 10).num_pairs == 0);
  REQUIRE_THROWS_AS(relative_pose_error(drifting, std::vector<SE3>(10), 0), ContractViolation);
}

}  // namespace
}  // namespace foothold

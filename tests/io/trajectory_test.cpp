// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "trajectory.h"

#include "io_fixtures.h"
#include "support/catch.h"
#include "support/random_motion.h"
#include "support/random_seed.h"

namespace foothold {
namespace {

using namespace test;
using Catch::Matchers::Contains;

SE3 random_pose(Random& random) { return random_motion(random, 2.0F, 2.0F); }

constexpr const char* kIdentity = " 0 0 0 0 0 0 1\n";

}  // namespace

TEST_CASE("write_trajectory: reads back to single precision, times to a microsecond") {
  const TempFolder temp;
  Random random = test_random();
  std::vector<StampedPose> trajectory;
  for (int i = 0; i < 20; ++i) trajectory.push_back({1311868164.363181 + i / 30.0, random_pose(random)});
  write_trajectory(temp / "t.txt", trajectory);
  const std::vector<StampedPose> read = read_trajectory(temp / "t.txt");
  REQUIRE(read.size() == trajectory.size());
  for (std::size_t i = 0; i < read.size(); ++i) {
    CHECK(std::abs(read[i].timestamp_s - trajectory[i].timestamp_s) < 1e-6);
    CHECK(translation_distance_m(read[i].world_from_camera, trajectory[i].world_from_camera) < 1e-6F);
    CHECK(rotation_distance_rad(read[i].world_from_camera, trajectory[i].world_from_camera) < 1e-6F);
  }
}

TEST_CASE("parse_trajectory: sorts by time, keeps the first of equal times, skips comments") {
  const auto trajectory = io::parse_trajectory("# comment\n2 20 0 0 0 0 0 1\n\n1 10 0 0 0 0 0 1\r\n2 21 0 0 0 0 0 1\n", "t.txt");
  REQUIRE(trajectory.size() == 2);
  CHECK(trajectory[0].world_from_camera.translation.x() == 10.0F);
  CHECK(trajectory[1].world_from_camera.translation.x() == 20.0F);
}

TEST_CASE("parse_trajectory: a bad line is named, with the value") {
  const auto error = [](const std::string& text) { return error_of([&] { io::parse_trajectory(text, "t.txt"); }); };
  CHECK_THAT(error(""), Contains("t.txt") && Contains("no pose"));
  CHECK_THAT(error("1 0 0 0 0 0 0 1\n2 0 0 0\n"), Contains("line 2") && Contains("4 numbers"));
  CHECK_THAT(error("# x\n1 0 nan 0 0 0 0 1\n"), Contains("line 2") && Contains("'nan'") && Contains("ty"));
  CHECK_THAT(error("1 0 0 0 0 0 0 0\n"), Contains("quaternion of length 0"));
  CHECK_THAT(error("1 0 0 0 1 0 0 1\n"), Contains("quaternion of length 1.41"));
}

TEST_CASE("interpolate: between two poses, position is linear and rotation turns evenly") {
  Random random = test_random();
  const SE3 a = random_pose(random);
  Tangent6 turn;
  turn << 0.3F, -0.4F, 1.0F, 0.0F, 0.0F, 0.0F;
  const SE3 b{a.rotation * se3_exp(turn).rotation, a.translation + Eigen::Vector3f(1.0F, 2.0F, 3.0F)};
  const auto recorded = [](const SE3& pose) { return io::RecordedPose{pose.rotation.cast<double>(), pose.translation.cast<double>()}; };
  const std::vector<io::TruePose> trajectory{{10.0, recorded(a)}, {10.1, recorded(b)}};
  for (const float t : {0.0F, 0.25F, 0.5F, 1.0F}) {
    const auto pose = io::interpolate(trajectory, 10.0 + 0.1 * static_cast<double>(t), 0.2);
    REQUIRE(pose.has_value());
    const SE3 between = to_se3(*pose, Eigen::Vector3d::Zero());
    CHECK((between.translation - a.translation - t * Eigen::Vector3f(1.0F, 2.0F, 3.0F)).norm() < 1e-5F);
    CHECK(rotation_distance_rad(between, {a.rotation * se3_exp(t * turn).rotation, between.translation}) < 1e-5F);
  }
}

TEST_CASE("interpolate: silent outside the trajectory and in its gaps, but not at its stamps") {
  const io::RecordedPose pose;
  const std::vector<io::TruePose> trajectory{{1.0, pose}, {1.05, pose}, {2.0, pose}, {2.05, std::nullopt}, {2.1, pose}};
  CHECK_FALSE(io::interpolate(trajectory, 0.99, 0.1).has_value());
  CHECK_FALSE(io::interpolate(trajectory, 2.11, 0.1).has_value());
  CHECK_FALSE(io::interpolate(trajectory, 1.5, 0.1).has_value());
  CHECK(io::interpolate(trajectory, 1.02, 0.1).has_value());
  CHECK(io::interpolate(trajectory, 2.0, 0.1).has_value());
  CHECK_FALSE(io::interpolate(trajectory, 2.02, 0.1).has_value());  // beside a lost sample
  CHECK_FALSE(io::interpolate(trajectory, 2.05, 0.1).has_value());
  CHECK_FALSE(io::interpolate({}, 2.0, 0.1).has_value());
}

TEST_CASE("parse_ground_truth: lost samples stay, without a pose") {
  const auto truth = io::parse_ground_truth("1 0 0 0 0 0 0 1\n2 nan 0 0 0 0 0 1\n3 0 0 0 0 0 0 0\n4 -inf 0 0 0 0 0 1\n", "t.txt");
  REQUIRE(truth.size() == 4);
  CHECK(truth[0].pose.has_value());
  for (const std::size_t i : {1, 2, 3}) CHECK_FALSE(truth[i].pose.has_value());
  CHECK_THAT(error_of([] { io::parse_ground_truth("1 0 0 0 0 0 0 2\n", "t.txt"); }), Contains("quaternion of length 2"));
  CHECK_THAT(error_of([] { io::parse_ground_truth("nan 0 0 0 0 0 0 1\n", "t.txt"); }), Contains("the time") || Contains("timestamp"));
}

TEST_CASE("write_trajectory: adds the recording's origin, to the millimetre") {
  const TempFolder temp;
  SE3 pose;
  pose.translation << 0.125F, -0.5F, 2.25F;
  write_trajectory(temp / "t.txt", {{1.0, pose}}, {481234.0, 5412345.0, 300.0});
  CHECK_THAT(read_text(temp / "t.txt"), Contains(" 481234.125 5412344.5 302.25 "));
}

TEST_CASE("read_trajectory: a missing file is named") {
  const TempFolder temp;
  CHECK_THAT(error_of([&] { read_trajectory(temp / "absent.txt"); }), Contains(temp / "absent.txt"));
  write_text(temp / "t.txt", std::string("1") + kIdentity);
  CHECK(read_trajectory(temp / "t.txt").size() == 1);
}

}  // namespace foothold

// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// Lists of poses: rows, logs and odometry. What is accepted is rigid.
#include "fuzz.h"
#include "pose_lists.h"
#include "stray_scanner_sequence.h"
#include "text_file.h"

FOOTHOLD_FUZZ_TARGET(pose_list) {
  using namespace foothold;
  const std::string text = io::plain_text(fuzz::text_of(data, size));
  const auto check = [](const std::optional<io::RecordedPose>& pose) {
    if (pose.has_value()) fuzz::require(is_rigid(to_se3(*pose, Eigen::Vector3d::Zero()), 1e-4F));
  };
  fuzz::attempt([&] {
    const auto poses = io::parse_pose_list(text, "traj.txt");
    fuzz::require(!poses.empty() && poses.begin()->first >= 0);
    for (const auto& [number, pose] : poses) check(pose);
  });
  fuzz::attempt([&] {
    for (const io::OdometryRow& row : io::parse_odometry(text, "odometry.csv")) {
      fuzz::require(row.frame >= 0);
      check(row.pose);
    }
  });
  return 0;
}

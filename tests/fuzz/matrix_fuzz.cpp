// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// Poses as matrices, and conventions: what is accepted is rigid.
#include "calibration_file.h"
#include "fuzz.h"
#include "recorded_pose.h"
#include "text_file.h"

FOOTHOLD_FUZZ_TARGET(matrix) {
  using namespace foothold;
  const std::string text = io::plain_text(fuzz::text_of(data, size));
  fuzz::attempt([&] { fuzz::require(is_rigid(io::parse_transform(text, "pose.txt"), 1e-5F)); });
  fuzz::attempt([&] {
    const std::optional<io::RecordedPose> pose = io::parse_pose(text, "pose.txt");
    if (!pose.has_value()) return;
    for (const char* words : {"as-is", "inverse,opengl,mm", "w-first,ros", "mirror-y,cm"}) {
      const io::RecordedPose read = apply(io::parse_pose_convention(words), *pose);
      fuzz::require(is_rigid(to_se3(read, Eigen::Vector3d::Zero()), 1e-4F));
    }
  });
  fuzz::attempt([&] {
    const io::PoseConvention convention = io::parse_pose_convention(text);
    fuzz::require(io::parse_pose_convention(to_string(convention)) == convention);
  });
  return 0;
}

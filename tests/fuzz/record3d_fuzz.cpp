// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// metadata.json of Record3D: what is accepted is a camera that projects, poses that are rigid, and times that rise.
#include <cmath>

#include "fuzz.h"
#include "record3d_metadata.h"

FOOTHOLD_FUZZ_TARGET(record3d) {
  using namespace foothold;
  const std::string text = fuzz::text_of(data, size);
  fuzz::attempt([&] {
    const io::Record3dMetadata metadata = io::parse_record3d_metadata(text, "metadata.json");
    if (metadata.camera.has_value()) fuzz::require(is_valid(metadata.camera->intrinsics));
    for (const auto& pose : metadata.poses) {
      if (pose.has_value()) fuzz::require(is_rigid(to_se3(*pose, Eigen::Vector3d::Zero()), 1e-4F));
    }
    for (std::size_t i = 1; i < metadata.times_s.size(); ++i) fuzz::require(metadata.times_s[i - 1] < metadata.times_s[i]);
    fuzz::require(metadata.frame_rate_hz >= 0.0 && metadata.frame_rate_hz <= 1e3 && metadata.variation >= 0.0F);
  });
  fuzz::attempt([&] {
    for (const auto& row : io::json_rows(text, "poses", "metadata.json")) fuzz::require(!row.empty());
  });
  return 0;
}

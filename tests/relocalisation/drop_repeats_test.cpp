// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include <vector>

#include "pose/hypothesis_kernels.h"
#include "support/catch.h"

namespace foothold {
namespace {

SE3 turned_and_moved(float angle_rad, float distance_m) {
  Tangent6 twist = Tangent6::Zero();
  twist[1] = angle_rad;
  SE3 pose = se3_exp(twist);
  pose.translation.x() += distance_m;
  return pose;
}

TEST_CASE("DropRepeats: of hypotheses that are near in place and in rotation, the first alone does not fail") {
  constexpr float kDistanceM = 0.1F;
  constexpr float kAngleRad = 0.1F;
  std::vector<SE3> poses = {turned_and_moved(0.0F, 0.0F),  turned_and_moved(0.0F, 0.09F), turned_and_moved(0.0F, 0.11F),
                            turned_and_moved(0.09F, 0.0F), turned_and_moved(0.2F, 0.0F),  turned_and_moved(0.2F, 0.01F)};
  std::vector<float> energies(poses.size(), 1.0F);
  std::vector<std::uint64_t> order = {1, 0, 2, 3, 4, 5};  // hypothesis 1 is the better of the first two
  const DropRepeats body{{poses.data(), energies.data(), order.data()}, kDistanceM, kAngleRad};
  for (std::size_t slot = 0; slot < order.size(); ++slot) body(slot);
  std::vector<std::size_t> left;
  for (std::size_t i = 0; i < poses.size(); ++i) {
    if (energies[i] < kFailedEnergy) left.push_back(i);
  }
  // 2 is near 1, and 3 near 0, which has failed itself; 4 is turned too far from all before it, and 5 near 4.
  CHECK(left == std::vector<std::size_t>{1, 4});
}

}  // namespace
}  // namespace foothold

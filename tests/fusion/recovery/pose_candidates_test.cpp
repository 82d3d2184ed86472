// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "foothold/fusion/pose_candidates.h"

#include <Eigen/Geometry>

#include "foothold/base/error.h"
#include "support/catch.h"

namespace foothold {
namespace {

SE3 at(float x_m) {
  SE3 pose;
  pose.translation = {x_m, 0.0F, 0.0F};
  return pose;
}

RefinedPose seen(const SE3& world_from_camera, float probability) {
  RefinedPose pose;
  pose.world_from_camera = world_from_camera;
  pose.probability = probability;
  return pose;
}

void weigh(PoseCandidates& candidates, const std::vector<RefinedPose>& refined) { candidates.weigh(refined); }

constexpr float kStep_m = 0.15F;  // enough for a new view

TEST_CASE("PoseCandidates: move with the camera") {
  PoseCandidates candidates;
  SE3 turned = at(1.0F);
  turned.rotation = Eigen::AngleAxisf(0.5F, Eigen::Vector3f::UnitZ()).toRotationMatrix();
  weigh(candidates, {seen(turned, 0.8F)});
  candidates.move(at(0.1F));
  const std::vector<PoseEstimate> proposals = candidates.proposals();
  REQUIRE(proposals.size() == 1);
  CHECK(is_near(proposals.front().world_from_camera, turned * at(0.1F), 1e-6F, 1e-3F));
  CHECK(proposals.front().confidence == 0.0F);
}

TEST_CASE("PoseCandidates: one view never settles where the camera is, three from different places do") {
  PoseCandidates candidates;
  for (int view = 0; view < 3; ++view) {
    CHECK(candidates.standing_alone() == nullptr);
    candidates.move(at(kStep_m));
    weigh(candidates, {seen(at(kStep_m * static_cast<float>(view)), 0.95F)});
  }
  REQUIRE(candidates.standing_alone() != nullptr);
  CHECK(is_near(*candidates.standing_alone(), at(2.0F * kStep_m), 1e-6F, 1e-3F));
}

TEST_CASE("PoseCandidates: the same view again adds nothing, and its worst look counts") {
  PoseCandidates candidates;
  for (int frame = 0; frame < 20; ++frame) weigh(candidates, {seen(at(0.0F), 0.95F)});
  CHECK(candidates.standing_alone() == nullptr);

  PoseCandidates doubted;
  for (int view = 0; view < 4; ++view) {
    const SE3 pose = at(kStep_m * static_cast<float>(view));
    doubted.move(at(kStep_m));
    weigh(doubted, {seen(pose, 0.95F)});
    weigh(doubted, {seen(pose, 0.4F)});
    weigh(doubted, {seen(pose, 0.95F)});
  }
  CHECK(doubted.standing_alone() == nullptr);
}

TEST_CASE("PoseCandidates: two places that explain every view alike leave it open, until a view tells them apart") {
  PoseCandidates candidates;
  const SE3 other = at(5.0F);
  for (int view = 0; view < 5; ++view) {
    const SE3 moved = at(kStep_m * static_cast<float>(view));
    candidates.move(at(kStep_m));
    weigh(candidates, {seen(moved, 0.95F), seen(other * moved, 0.94F)});
    CHECK(candidates.standing_alone() == nullptr);
  }
  const SE3 moved = at(5.0F * kStep_m);
  candidates.move(at(kStep_m));
  weigh(candidates, {seen(moved, 0.95F), seen(other * moved, 0.02F)});
  REQUIRE(candidates.standing_alone() != nullptr);
  CHECK(is_near(*candidates.standing_alone(), moved, 1e-6F, 1e-3F));
  CHECK(candidates.is_likeliest(moved));
  CHECK_FALSE(candidates.is_likeliest(other * moved));
}

TEST_CASE("PoseCandidates: what is not seen again is dropped, and there are never more than asked for") {
  PoseCandidatesSettings settings;
  settings.max_candidates = 2;
  settings.max_frames_unseen = 3;
  PoseCandidates candidates(settings);
  weigh(candidates, {seen(at(0.0F), 0.9F), seen(at(5.0F), 0.8F), seen(at(10.0F), 0.7F)});
  CHECK(candidates.proposals().size() == 2);
  for (int frame = 0; frame < 4; ++frame) weigh(candidates, {});
  CHECK(candidates.empty());
}

TEST_CASE("PoseCandidates: hopeless poses are no candidates") {
  PoseCandidates candidates;
  weigh(candidates, {seen(at(0.0F), 0.01F)});
  CHECK(candidates.empty());
}

TEST_CASE("PoseCandidatesSettings: out of range") {
  PoseCandidatesSettings settings;
  settings.max_candidates = 0;
  CHECK_THROWS_AS(PoseCandidates(settings), InvalidSettings);
}

}  // namespace
}  // namespace foothold

// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "foothold/evaluation/view_overlap.h"

#include "foothold/base/error.h"
#include "support/catch.h"

namespace foothold {
namespace {

/// A camera at (x, 0, 0) that looks along z at a wall.
std::shared_ptr<const RgbdFrame> wall_seen_from(float x_m, float wall_m = 2.0F) {
  auto frame = std::make_shared<RgbdFrame>();
  frame->depth = Image<float>(80, 60);
  for (std::size_t i = 0; i < frame->depth.size(); ++i) frame->depth.data()[i] = wall_m;
  const Intrinsics camera{80.0F, 80.0F, 39.5F, 29.5F};
  frame->calibration = {camera, camera, SE3{}};
  frame->world_from_camera = SE3{};
  frame->world_from_camera->translation.x() = x_m;
  return frame;
}

TEST_CASE("share_seen: is the overlap of what two cameras see of a wall") {
  const auto view = wall_seen_from(0.0F);
  REQUIRE(share_seen(*view, {}) == 0.0);
  REQUIRE(share_seen(*view, {view}) == 1.0);
  // The view is 2 m wide on the wall; a grid of 20 columns is asked.
  REQUIRE(share_seen(*view, {wall_seen_from(0.5F)}) == Approx(0.75).margin(0.05));
  REQUIRE(share_seen(*view, {wall_seen_from(-0.5F), wall_seen_from(1.5F)}) == Approx(1.0).margin(0.05));
  REQUIRE(share_seen(*view, {wall_seen_from(2.5F)}) == 0.0);
}

TEST_CASE("share_seen: what stands before or behind the surface hides it") {
  const auto view = wall_seen_from(0.0F);
  REQUIRE(share_seen(*view, {wall_seen_from(0.0F, 1.5F)}) == 0.0);
  REQUIRE(share_seen(*view, {wall_seen_from(0.0F, 2.05F)}) == 1.0);
}

TEST_CASE("share_seen: a view without depth has seen nothing, and a pose is needed") {
  REQUIRE(share_seen(*wall_seen_from(0.0F, 0.0F), {wall_seen_from(0.0F)}) == 0.0);
  RgbdFrame lost = *wall_seen_from(0.0F);
  lost.world_from_camera.reset();
  REQUIRE_THROWS_AS(share_seen(lost, {}), ContractViolation);
}

}  // namespace
}  // namespace foothold

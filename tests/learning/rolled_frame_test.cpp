// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "rolled_frame.h"

#include "fake_sequence.h"
#include "support/catch.h"

namespace foothold {
namespace {

constexpr float kPi = 3.14159265F;
// A nearest pixel is up to half a pixel off in u and v: 1 cm at 73 px focal length and 2 m; the wavy wall then differs by up to 3 cm in
// depth.
constexpr float kPixelErrorM = 0.05F;

float farthest_point_m(const RgbdFrame& frame, const RgbdFrame& rolled, int& num_points) {
  float farthest_m = 0.0F;
  num_points = 0;
  for (int v = 0; v < rolled.depth.height(); ++v) {
    for (int u = 0; u < rolled.depth.width(); ++u) {
      if (rolled.depth(u, v) <= 0.0F) continue;
      const Eigen::Vector3f point_world = *rolled.world_from_camera * rolled.calibration.depth.back_project(
                                                                          static_cast<float>(u), static_cast<float>(v), rolled.depth(u, v));
      const Eigen::Vector3f point_camera = frame.world_from_camera->inverse() * point_world;
      const Eigen::Vector2f pixel = frame.calibration.depth.project(point_camera);
      const int old_u = static_cast<int>(std::lround(pixel.x()));
      const int old_v = static_cast<int>(std::lround(pixel.y()));
      if (!frame.depth.view().contains(old_u, old_v)) continue;
      farthest_m = std::max(farthest_m, std::abs(frame.depth(old_u, old_v) - point_camera.z()));
      ++num_points;
    }
  }
  return farthest_m;
}

}  // namespace

TEST_CASE("rolled_frame: shows the same surface from the turned camera") {
  const RgbdFrame frame = test::FakeSequence("wall", 4).load(3);
  for (const float angle_rad : {0.3F, -1.2F, 0.5F * kPi, kPi}) {
    const RgbdFrame rolled = rolled_frame(frame, angle_rad);
    int num_points = 0;
    CHECK(farthest_point_m(frame, rolled, num_points) < kPixelErrorM);
    CHECK(num_points > 80 * 60 / 2);
    CHECK(rotation_distance_rad(*frame.world_from_camera, *rolled.world_from_camera) == Approx(std::abs(angle_rad)).margin(1e-3));
  }
}

TEST_CASE("rolled_frame: no turn changes nothing, and half a turn twice neither") {
  const RgbdFrame frame = test::FakeSequence("wall", 1).load(0);
  const RgbdFrame same = rolled_frame(frame, 0.0F);
  const RgbdFrame twice = rolled_frame(rolled_frame(frame, kPi), kPi);
  for (int v = 0; v < frame.depth.height(); ++v) {
    for (int u = 0; u < frame.depth.width(); ++u) {
      REQUIRE(same.depth(u, v) == frame.depth(u, v));
      REQUIRE(same.colour(u, v).g == frame.colour(u, v).g);
      REQUIRE(twice.depth(u, v) == frame.depth(u, v));
    }
  }
}

TEST_CASE("rolled_frame: what the frame did not see has no depth, and a frame without a pose stays so") {
  const RgbdFrame rolled = rolled_frame(test::FakeSequence("wall", 1, 0.0F, false).load(0), 0.5F * kPi);
  CHECK(rolled.depth(0, 30) == 0.0F);
  CHECK(rolled.depth(40, 30) > 0.0F);
  CHECK_FALSE(rolled.world_from_camera.has_value());
}

}  // namespace foothold

// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "foothold/synthetic/turned_frame.h"

#include "foothold/synthetic/synthetic_sequence.h"
#include "support/catch.h"

namespace foothold {
namespace {

RgbdFrame kitchen_frame() {
  return make_synthetic_sequence(parse_synthetic_spec("synthetic:kitchen?frames=1&width=64&height=48"), Context())->load(0);
}

/// The point of the world that a pixel shows.
Eigen::Vector3f world_point(const RgbdFrame& frame, int u, int v) {
  return *frame.world_from_camera * frame.calibration.depth.back_project(static_cast<float>(u), static_cast<float>(v), frame.depth(u, v));
}

TEST_CASE("turned_frame: what was right is below, and every pixel shows the same point of the world") {
  const RgbdFrame frame = kitchen_frame();
  const RgbdFrame turned = turned_frame(frame, 1);
  REQUIRE(turned.depth.width() == frame.depth.height());
  for (int v = 0; v < frame.depth.height(); ++v) {
    for (int u = 0; u < frame.depth.width(); ++u) {
      if (!(frame.depth(u, v) > 0.0F)) continue;
      const int turned_u = frame.depth.height() - 1 - v;
      REQUIRE(turned.depth(turned_u, u) == frame.depth(u, v));
      REQUIRE((world_point(turned, turned_u, u) - world_point(frame, u, v)).norm() < 1e-4F);
    }
  }
}

TEST_CASE("turned_frame: four quarters, and two mirrors, give the frame again") {
  const RgbdFrame frame = kitchen_frame();
  for (const RgbdFrame& same : {turned_frame(frame, 4), turned_frame(turned_frame(frame, 3), 1), mirrored_frame(mirrored_frame(frame))}) {
    REQUIRE(same.depth.width() == frame.depth.width());
    REQUIRE(translation_distance_m(*same.world_from_camera, *frame.world_from_camera) < 1e-5F);
    for (std::size_t i = 0; i < frame.depth.size(); ++i) REQUIRE(same.depth.data()[i] == frame.depth.data()[i]);
    REQUIRE(same.calibration.depth.cx == Approx(frame.calibration.depth.cx));
    REQUIRE(same.calibration.depth.fy == Approx(frame.calibration.depth.fy));
  }
}

}  // namespace
}  // namespace foothold

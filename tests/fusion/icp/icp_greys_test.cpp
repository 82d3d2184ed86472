// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include <cmath>

#include "foothold/base/contract.h"
#include "foothold/fusion/icp_tracker.h"
#include "fusion/scene.h"
#include "icp/icp_state.h"
#include "support/catch.h"

namespace foothold {
namespace {

/// The images of these tests have half the size of a camera's.
constexpr IcpLevels kGreyLevels{3, 0};

/// A corridor whose ends are out of sight.
test::Scene corridor() {
  test::Scene scene;
  scene.half_size_m.x() = 6.0;
  scene.sphere_centre_world = {0.0, 0.0, -100.0};
  return scene;
}

/// Paints what a frame sees with waves of 20 cm.
void paint_waves(RgbdFrame& frame) {
  for (int v = 0; v < frame.depth.height(); ++v) {
    for (int u = 0; u < frame.depth.width(); ++u) {
      const Eigen::Vector3f point =
          *frame.world_from_camera * frame.calibration.depth.back_project(static_cast<float>(u), static_cast<float>(v), frame.depth(u, v));
      const float wave = std::sin(31.4F * point.x()) + std::sin(31.4F * point.y()) + std::sin(31.4F * point.z());
      const auto grey = static_cast<std::uint8_t>(128.0F + 15.0F * wave);
      frame.colour(u, v) = {grey, grey, grey};
    }
  }
}

SE3 moved(const SE3& pose, float x_m) {
  SE3 result = pose;
  result.translation.x() += x_m;
  return result;
}

RgbdFrame painted_frame(const test::Scene& scene, const SE3& pose) {
  RgbdFrame frame = test::render(scene, pose);
  paint_waves(frame);
  return frame;
}

/// A painted frame and a rendering, with colour, of a map of it and of its neighbours along x.
struct Painted {
  explicit Painted(const test::Scene& scene) : frame(painted_frame(scene, pose)) {
    TsdfVolume volume(context, {});
    for (const float x_m : {-0.3F, -0.2F, -0.1F, 0.0F, 0.1F, 0.2F, 0.3F}) {
      const SE3 neighbour = moved(pose, x_m);
      volume.integrate(painted_frame(scene, neighbour).view(), neighbour);
    }
    Raycaster(context).render(volume, test::camera_of(frame), map, true);
  }

  Context context = test::make_context(1);
  SE3 pose = test::look_at({0.0F, 0.0F, 0.0F}, {0.3F, 0.9F, 1.5F});
  RgbdFrame frame;
  SurfaceMap map;
};

TEST_CASE("IcpTracker: between a wall and a floor, colour tells where along both, in another light, too") {
  Painted painted(corridor());
  IcpTracker tracker(painted.context, kGreyLevels);
  for (const int brighter : {0, 8}) {
    for (std::size_t i = 0; i < painted.frame.colour.size(); ++i) {
      Rgb8& colour = painted.frame.colour.data()[i];
      colour.r = colour.g = colour.b = static_cast<std::uint8_t>(colour.g + brighter);
    }
    tracker.set_frame(painted.frame.view());
    for (const float offset_m : {-0.03F, 0.0F, 0.03F}) {
      const TrackingResult result = tracker.track(painted.map, moved(painted.pose, offset_m));
      INFO("brighter by " << brighter << ", from " << offset_m << " m");
      REQUIRE(translation_distance_m(result.world_from_camera, painted.pose) < 0.005F);
      REQUIRE(rotation_distance_rad(result.world_from_camera, painted.pose) < 0.003F);
    }
  }
}

TEST_CASE("IcpTracker: greys are asked where surfaces leave the camera free and the rendering has colour") {
  Painted painted(corridor());
  IcpTracker tracker(painted.context, kGreyLevels);
  tracker.set_frame(painted.frame.view());
  const TrackingResult result = tracker.track(painted.map, painted.pose);
  REQUIRE(result.measures.well_posed);
  REQUIRE(result.hold > 0.0F);
  REQUIRE(result.hold < kLeastHold);
  REQUIRE(IcpTracker::needs_greys(painted.map, result));

  SurfaceMap without_colour = painted.map;
  without_colour.colours.resize(0);
  REQUIRE_FALSE(IcpTracker::needs_greys(without_colour, result));
  const Array<SE3> guesses(painted.context.memory(), Span<const SE3>(&painted.pose, 1));
  REQUIRE_THROWS_AS(tracker.align_all(without_colour, guesses, IcpResiduals::kDepthAndGrey), ContractViolation);
}

TEST_CASE("IcpTracker: where surfaces hold the camera, colour changes no bit of the pose") {
  const Painted painted{test::Scene{}};
  SurfaceMap without_colour = painted.map;
  without_colour.colours.resize(0);
  IcpTracker tracker(painted.context, kGreyLevels);
  tracker.set_frame(painted.frame.view());
  const SE3 guess = moved(painted.pose, 0.02F);
  const TrackingResult with = tracker.track(painted.map, guess);
  const TrackingResult without = tracker.track(without_colour, guess);
  REQUIRE(with.hold > kLeastHold);
  REQUIRE(with.hold <= 1.0F / 3.0F);
  REQUIRE(with.world_from_camera.translation == without.world_from_camera.translation);
  REQUIRE(with.world_from_camera.rotation == without.world_from_camera.rotation);
}

}  // namespace
}  // namespace foothold

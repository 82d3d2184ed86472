// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "register_colour.h"

#include <cmath>

#include "support/catch.h"

namespace foothold {
namespace {

/// A frame whose colour camera looks at a wall painted with a smooth gradient: red grows with x, green with y of the world.
RgbdFrame wall_frame(const RgbdCalibration& calibration, float wall_m) {
  RgbdFrame frame;
  frame.calibration = calibration;
  frame.depth = Image<float>(64, 48, wall_m);
  frame.colour = Image<Rgb8>(64, 48);
  // The wall is the plane z = wall_m of the depth camera; each colour pixel's ray is cut with it.
  for (int v = 0; v < 48; ++v) {
    for (int u = 0; u < 64; ++u) {
      const Eigen::Vector3f direction =
          calibration.depth_from_colour.rotation * calibration.colour.back_project(static_cast<float>(u), static_cast<float>(v), 1.0F);
      const Eigen::Vector3f origin = calibration.depth_from_colour.translation;
      const Eigen::Vector3f point_depth = origin + (wall_m - origin.z()) / direction.z() * direction;
      frame.colour(u, v) = {static_cast<std::uint8_t>(std::lround(128.0F + 80.0F * point_depth.x())),
                            static_cast<std::uint8_t>(std::lround(128.0F + 80.0F * point_depth.y())), 7};
    }
  }
  return frame;
}

RgbdCalibration kinect_like() {
  RgbdCalibration calibration;
  calibration.depth = {58.5F, 58.5F, 32.0F, 24.0F};
  calibration.colour = {50.0F, 50.0F, 31.0F, 23.5F};
  Tangent6 tangent;
  tangent << 0.01F, -0.02F, 0.005F, 0.1F, -0.03F, 0.01F;
  calibration.depth_from_colour = se3_exp(tangent);
  return calibration;
}

}  // namespace

TEST_CASE("register_colour: each depth pixel takes the colour of the point it sees") {
  RgbdFrame frame = wall_frame(kinect_like(), 1.2F);
  const Intrinsics depth_camera = frame.calibration.depth;
  io::register_colour(frame);
  // Grey levels: rounding of the source by 1/2 and of the result by 1/2, and 80 * 1.2 / 50 = 1.9 levels a pixel, linear but for
  // perspective.
  constexpr float kTolerance = 1.6F;
  for (int v = 8; v < 40; ++v) {
    for (int u = 8; u < 56; ++u) {
      const Eigen::Vector3f point = depth_camera.back_project(static_cast<float>(u), static_cast<float>(v), 1.2F);
      CHECK(std::abs(frame.colour(u, v).r - (128.0F + 80.0F * point.x())) < kTolerance);
      CHECK(std::abs(frame.colour(u, v).g - (128.0F + 80.0F * point.y())) < kTolerance);
      CHECK(frame.colour(u, v).b == 7);
    }
  }
  CHECK(frame.calibration.colour.fx == depth_camera.fx);
  CHECK(frame.calibration.depth_from_colour.translation.isZero());
  CHECK(frame.calibration.depth_from_colour.rotation.isIdentity());
}

TEST_CASE("register_colour: a pixel without depth assumes the median depth of the frame") {
  RgbdFrame whole = wall_frame(kinect_like(), 1.2F);
  RgbdFrame holed = whole;
  for (int u = 0; u < 64; u += 3) holed.depth(u, 20) = 0.0F;
  io::register_colour(whole);
  io::register_colour(holed);
  for (int u = 0; u < 64; ++u) CHECK(holed.colour(u, 20).r == whole.colour(u, 20).r);
}

TEST_CASE("register_colour: a frame without any depth does not fail") {
  RgbdFrame frame = wall_frame(kinect_like(), 1.2F);
  frame.depth = Image<float>(64, 48, 0.0F);
  io::register_colour(frame);
  CHECK(frame.colour(32, 24).b == 7);
}

}  // namespace foothold

// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "foothold/api/frame.h"

#include <limits>

#include "support/catch.h"
#include "support/error_message.h"

namespace foothold {
namespace {

RgbdFrame well_formed_frame() {
  RgbdFrame frame;
  frame.depth = Image<float>(8, 6, 1.5F);
  frame.colour = Image<Rgb8>(8, 6, Rgb8{10, 20, 30});
  frame.calibration.depth = frame.calibration.colour = {585.0F, 585.0F, 320.0F, 240.0F};
  return frame;
}

TEST_CASE("describe_frame_error: is empty for a well formed frame, blank depth included") {
  RgbdFrame frame = well_formed_frame();
  REQUIRE(describe_frame_error(frame.view()).empty());
  frame.depth = Image<float>(8, 6, -1.0F);
  REQUIRE(describe_frame_error(frame.view()).empty());
}

TEST_CASE("describe_frame_error: names what is missing") {
  RgbdFrame frame = well_formed_frame();
  frame.depth = {};
  REQUIRE(test::contains(describe_frame_error(frame.view()), "depth image is empty"));
  frame = well_formed_frame();
  frame.colour = {};
  REQUIRE(test::contains(describe_frame_error(frame.view()), "colour image is empty"));
  REQUIRE_FALSE(describe_frame_error(Frame{}).empty());
}

TEST_CASE("describe_frame_error: gives both sizes where they differ") {
  RgbdFrame frame = well_formed_frame();
  frame.colour = Image<Rgb8>(4, 6);
  const std::string message = describe_frame_error(frame.view());
  REQUIRE(test::contains(message, "8x6"));
  REQUIRE(test::contains(message, "4x6"));
}

TEST_CASE("describe_frame_error: wants depth and colour in one kind of memory") {
  const RgbdFrame frame = well_formed_frame();
  Frame view = frame.view();
  view.colour.memory = MemoryKind::kCuda;
  REQUIRE(test::contains(describe_frame_error(view), "memory"));
}

TEST_CASE("describe_frame_error: accepts 3 and 4 bytes per pixel") {
  const RgbdFrame frame = well_formed_frame();
  Frame view = frame.view();
  view.colour.bytes_per_pixel = 4;
  REQUIRE(describe_frame_error(view).empty());
  for (const int bytes : {0, 1, 2, 5}) {
    view.colour.bytes_per_pixel = bytes;
    REQUIRE(test::contains(describe_frame_error(view), std::to_string(bytes) + " bytes per pixel"));
  }
}

TEST_CASE("describe_frame_error: gives focal lengths that point the wrong way, and says what to do") {
  RgbdFrame frame = well_formed_frame();
  frame.calibration.depth.fy = -585.0F;
  REQUIRE(test::contains(describe_frame_error(frame.view()), "fy = -585"));
  REQUIRE(test::contains(describe_frame_error(frame.view()), "flip the rows"));
}

TEST_CASE("describe_frame_error: wants a rigid transform between the cameras") {
  RgbdFrame frame = well_formed_frame();
  frame.calibration.depth_from_colour.rotation(2, 2) = -1.0F;
  REQUIRE(test::contains(describe_frame_error(frame.view()), "depth_from_colour's rotation mirrors"));
  frame.calibration.depth_from_colour.rotation = 1000.0F * Eigen::Matrix3f::Identity();
  REQUIRE(test::contains(describe_frame_error(frame.view()), "depth_from_colour's rotation scales"));
}

TEST_CASE("describe_frame_error: wants usable intrinsics of both cameras") {
  for (const float focal : {0.0F, -585.0F, std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()}) {
    RgbdFrame frame = well_formed_frame();
    frame.calibration.depth.fy = focal;
    REQUIRE(test::contains(describe_frame_error(frame.view()), "depth intrinsics"));
    frame = well_formed_frame();
    frame.calibration.colour.fx = focal;
    REQUIRE(test::contains(describe_frame_error(frame.view()), "colour intrinsics"));
  }
}

TEST_CASE("RgbdFrame: its view points at its own images") {
  const RgbdFrame frame = well_formed_frame();
  const Frame view = frame.view();
  REQUIRE(view.depth.data == frame.depth.data());
  REQUIRE(view.depth(7, 5) == 1.5F);
  REQUIRE(view.colour(7, 5).g == 20);
  REQUIRE(view.depth.memory == MemoryKind::kHost);
}

}  // namespace
}  // namespace foothold

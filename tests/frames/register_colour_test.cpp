// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "foothold/frames/register_colour.h"

#include <algorithm>
#include <cmath>

#include "foothold/base/error.h"
#include "support/catch.h"
#include "support/error_message.h"
#include "support/random_seed.h"

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

bool same(Rgb8 a, Rgb8 b) { return a.r == b.r && a.g == b.g && a.b == b.b; }

/// Where the point of a depth pixel is in the colour image, or the nearest place inside.
Eigen::Vector2d colour_position(const RgbdFrame& frame, int u, int v) {
  const Intrinsics& depth = frame.calibration.depth;
  const Intrinsics& colour = frame.calibration.colour;
  const double z = frame.depth(u, v);
  const Eigen::Vector3d point_depth(z * (static_cast<double>(u) - depth.cx) / depth.fx, z * (static_cast<double>(v) - depth.cy) / depth.fy,
                                    z);
  const SE3& depth_from_colour = frame.calibration.depth_from_colour;
  const Eigen::Vector3d point =
      depth_from_colour.rotation.cast<double>().transpose() * (point_depth - depth_from_colour.translation.cast<double>());
  return {std::clamp(colour.fx * point.x() / point.z() + colour.cx, 0.0, frame.colour.width() - 1.0),
          std::clamp(colour.fy * point.y() / point.z() + colour.cy, 0.0, frame.colour.height() - 1.0)};
}

double bilinear(const Image<Rgb8>& image, const Eigen::Vector2d& at, std::uint8_t Rgb8::*channel) {
  double sum = 0.0;
  for (int v = 0; v < image.height(); ++v) {
    for (int u = 0; u < image.width(); ++u) {
      sum += std::max(0.0, 1.0 - std::abs(at.x() - u)) * std::max(0.0, 1.0 - std::abs(at.y() - v)) * (image(u, v).*channel);
    }
  }
  return sum;
}

}  // namespace

TEST_CASE("register_colour: each depth pixel takes the colour of the point it sees") {
  RgbdFrame frame = wall_frame(kinect_like(), 1.2F);
  const Intrinsics depth_camera = frame.calibration.depth;
  register_colour(frame);
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
  register_colour(whole);
  register_colour(holed);
  for (int u = 0; u < 64; ++u) CHECK(holed.colour(u, 20).r == whole.colour(u, 20).r);
}

TEST_CASE("register_colour: a registered frame stays as it is") {
  RgbdFrame frame = wall_frame(kinect_like(), 1.2F);
  frame.calibration.colour = frame.calibration.depth;
  CHECK_FALSE(is_registered(frame.calibration));
  frame.calibration.depth_from_colour = SE3{};
  CHECK(is_registered(frame.calibration));
  const Image<Rgb8> before = frame.colour;
  register_colour(frame);
  for (std::size_t i = 0; i < before.size(); ++i) CHECK(same(frame.colour.data()[i], before.data()[i]));
  frame.calibration.colour.cy += 0.5F;
  CHECK_FALSE(is_registered(frame.calibration));
}

TEST_CASE("register_colour: agrees with the bilinear colour of each pixel's own point, in noise and at borders") {
  Random random = test::test_random();
  RgbdFrame frame;
  frame.calibration = kinect_like();
  frame.depth = Image<float>(64, 48);
  frame.colour = Image<Rgb8>(64, 48);
  for (std::size_t i = 0; i < frame.depth.size(); ++i) {
    frame.depth.data()[i] = random.uniform(0.3F, 5.0F);
    const auto level = [&] { return static_cast<std::uint8_t>(random.uniform(0.0F, 255.9F)); };
    frame.colour.data()[i] = {level(), level(), level()};
  }
  RgbdFrame registered = frame;
  register_colour(registered);
  // Grey levels: positions are rounded by up to 1/128 pixel along each axis, where neighbours differ by up to 255; and the result by 1/2.
  constexpr double kTolerance = 2.0 * 255.0 / 128.0 + 0.51;
  int num_at_border = 0;
  for (int v = 0; v < 48; ++v) {
    for (int u = 0; u < 64; ++u) {
      const Eigen::Vector2d at = colour_position(frame, u, v);
      num_at_border += at.x() == 0.0 || at.x() == 63.0 || at.y() == 0.0 || at.y() == 47.0 ? 1 : 0;
      for (const auto channel : {&Rgb8::r, &Rgb8::g, &Rgb8::b}) {
        CHECK(std::abs(registered.colour(u, v).*channel - bilinear(frame.colour, at, channel)) < kTolerance);
      }
    }
  }
  CHECK(num_at_border > 20);  // or the border would not be tested
}

TEST_CASE("register_colour: what lies behind the colour camera is black") {
  RgbdFrame frame = wall_frame(kinect_like(), 1.2F);
  frame.calibration.depth_from_colour = SE3{};
  frame.calibration.depth_from_colour.translation.z() = 2.0F;
  frame.depth(10, 10) = 4.0F;
  register_colour(frame);
  CHECK(same(frame.colour(11, 10), Rgb8{}));
  CHECK(frame.colour(10, 10).b == 7);
}

TEST_CASE("register_colour: a frame without any depth does not fail") {
  RgbdFrame frame = wall_frame(kinect_like(), 1.2F);
  frame.depth = Image<float>(64, 48, 0.0F);
  register_colour(frame);
  CHECK(frame.colour(32, 24).b == 7);
}

TEST_CASE("register_colour: RGB and RGBA in the caller's memory give the same, and the frame views the caller's image") {
  const RgbdFrame owned = wall_frame(kinect_like(), 1.2F);
  std::vector<std::uint8_t> rgba;
  for (std::size_t i = 0; i < owned.colour.size(); ++i) {
    const Rgb8 pixel = owned.colour.data()[i];
    rgba.insert(rgba.end(), {pixel.r, pixel.g, pixel.b, 99});
  }
  Frame frame = owned.view();
  frame.colour = {rgba.data(), 64, 48, 4, MemoryKind::kHost};
  RgbdFrame expected = owned;
  register_colour(expected);
  Image<Rgb8> registered;
  const Frame result = register_colour(frame, registered);
  CHECK(is_registered(result));
  CHECK(describe_frame_error(result).empty());
  CHECK(result.depth.data == owned.depth.data());
  CHECK(result.colour.data == &registered.data()->r);
  for (std::size_t i = 0; i < registered.size(); ++i) CHECK(same(registered.data()[i], expected.colour.data()[i]));

  const Rgb8* const memory = registered.data();
  register_colour(frame, registered);
  CHECK(registered.data() == memory);  // kept
  CHECK(register_colour(result, registered).colour.data == result.colour.data);
}

TEST_CASE("register_colour: colour of another size is warped to that of depth") {
  RgbdFrame frame = wall_frame(kinect_like(), 1.2F);
  RgbdFrame same_size = frame;
  register_colour(same_size);
  // The same camera with twice the resolution, each pixel four times.
  Image<Rgb8> large(128, 96);
  for (int v = 0; v < 96; ++v) {
    for (int u = 0; u < 128; ++u) large(u, v) = frame.colour(u / 2, v / 2);
  }
  frame.colour = large;
  frame.calibration.colour = frame.calibration.colour.scaled(2.0F);
  CHECK_FALSE(is_registered(frame.view()));
  register_colour(frame);
  REQUIRE(frame.colour.width() == 64);
  REQUIRE(frame.colour.height() == 48);
  constexpr int kTolerance = 2;  // grey levels: up to two differ between neighbours
  for (int v = 8; v < 40; ++v) {
    for (int u = 8; u < 56; ++u) CHECK(std::abs(frame.colour(u, v).r - same_size.colour(u, v).r) <= kTolerance);
  }
}

TEST_CASE("register_colour: a malformed frame breaks the contract, and the text says how") {
  RgbdFrame frame = wall_frame(kinect_like(), 1.2F);
  frame.calibration.colour.fy = -50.0F;
  Image<Rgb8> registered;
  CHECK(test::contains(test::error_message<ContractViolation>([&] { register_colour(frame.view(), registered); }), "fy = -50"));
  frame.calibration.colour.fy = 50.0F;
  Frame on_device = frame.view();
  on_device.depth.memory = on_device.colour.memory = MemoryKind::kCuda;
  CHECK_THROWS_AS(register_colour(on_device, registered), ContractViolation);
}

}  // namespace foothold

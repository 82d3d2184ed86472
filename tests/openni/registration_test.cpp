// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "registration.h"

#include <cmath>
#include <limits>

#include "support/catch.h"
#include "support/random_seed.h"

namespace foothold::test {
namespace {

constexpr int kWidth = 160;
constexpr int kHeight = 120;
constexpr float kRounding_m = 1e-5F;

RgbdCalibration same_cameras() {
  RgbdCalibration calibration;
  calibration.depth = {150.0F, 150.0F, 79.5F, 59.5F};
  calibration.colour = calibration.depth;
  return calibration;
}

Image<float> register_image(const Image<float>& depth, const RgbdCalibration& calibration) {
  Image<float> registered;
  capture::register_depth_to_colour(depth, calibration, registered);
  return registered;
}

TEST_CASE("register_depth_to_colour: changes nothing for two cameras in one place") {
  Random random = test_random();
  Image<float> depth(kWidth, kHeight);
  for (std::size_t i = 0; i < depth.size(); ++i) depth.data()[i] = random.uniform() < 0.1F ? 0.0F : random.uniform(0.5F, 4.0F);
  const Image<float> registered = register_image(depth, same_cameras());
  int num_different = 0;
  for (std::size_t i = 0; i < depth.size(); ++i) {
    // A pixel without a measurement may be covered by its nearest neighbour's slightly enlarged square, others may not change.
    if (depth.data()[i] != 0.0F && std::abs(registered.data()[i] - depth.data()[i]) > kRounding_m) ++num_different;
  }
  CHECK(num_different == 0);
}

TEST_CASE("register_depth_to_colour: a wall shifts by the disparity, without gaps") {
  RgbdCalibration calibration = same_cameras();
  calibration.depth_from_colour.translation = {0.1F, 0.0F, 0.0F};  // the colour camera is 10 cm to the right
  const Image<float> registered = register_image(Image<float>(kWidth, kHeight, 1.5F), calibration);
  const int disparity_px = 10;  // 150 px * 0.1 m / 1.5 m
  for (int v = 0; v < kHeight; ++v) {
    for (int u = 0; u < kWidth; ++u) {
      INFO("pixel " << u << ", " << v);
      REQUIRE(registered(u, v) == Approx(u < kWidth - disparity_px ? 1.5F : 0.0F).margin(kRounding_m));
    }
  }
}

TEST_CASE("register_depth_to_colour: depth is measured along the colour camera's axis") {
  RgbdCalibration calibration = same_cameras();
  calibration.depth_from_colour.translation = {0.0F, 0.0F, 0.25F};  // the colour camera is 25 cm further ahead
  const Image<float> registered = register_image(Image<float>(kWidth, kHeight, 1.5F), calibration);
  for (std::size_t i = 0; i < registered.size(); ++i) REQUIRE(registered.data()[i] == Approx(1.25F).margin(kRounding_m));
}

TEST_CASE("register_depth_to_colour: what is near hides what is behind") {
  RgbdCalibration calibration = same_cameras();
  calibration.depth_from_colour.translation = {0.1F, 0.0F, 0.0F};
  Image<float> depth(kWidth, kHeight, 3.0F);
  for (int v = 0; v < kHeight; ++v) {
    for (int u = 80; u < 100; ++u) depth(u, v) = 1.0F;
  }
  const Image<float> registered = register_image(depth, calibration);
  CHECK(registered(70, 60) == Approx(1.0F));  // 15 px to the left
  CHECK(registered(84, 60) == Approx(1.0F));
  CHECK(registered(50, 60) == Approx(3.0F));
  CHECK(registered(90, 60) == 0.0F);  // seen by the colour camera only
  CHECK(registered(110, 60) == Approx(3.0F));
}

TEST_CASE("register_depth_to_colour: a colour camera with a longer lens sees no gaps") {
  RgbdCalibration calibration = same_cameras();
  calibration.colour.fx = calibration.colour.fy = 300.0F;
  const Image<float> registered = register_image(Image<float>(kWidth, kHeight, 2.0F), calibration);
  for (std::size_t i = 0; i < registered.size(); ++i) REQUIRE(registered.data()[i] == 2.0F);
}

TEST_CASE("register_depth_to_colour: a turned camera sees a slanted floor without gaps") {
  RgbdCalibration calibration = same_cameras();
  Tangent6 tangent;
  tangent << 0.01F, 0.02F, 0.03F, 0.03F, 0.0F, 0.0F;
  calibration.depth_from_colour = se3_exp(tangent);
  Image<float> depth(kWidth, kHeight);
  for (int v = 0; v < kHeight; ++v) {
    for (int u = 0; u < kWidth; ++u) depth(u, v) = 1.0F + 0.01F * static_cast<float>(kHeight - v);
  }
  const Image<float> registered = register_image(depth, calibration);
  int num_gaps = 0;
  for (int v = 20; v < kHeight - 20; ++v) {
    for (int u = 20; u < kWidth - 20; ++u) num_gaps += registered(u, v) == 0.0F ? 1 : 0;
  }
  CHECK(num_gaps == 0);
}

TEST_CASE("register_depth_to_colour: NaN, negative, infinite and tiny depth do no harm") {
  Image<float> depth(kWidth, kHeight, 0.0F);
  depth(10, 10) = std::numeric_limits<float>::quiet_NaN();
  depth(11, 10) = -1.0F;
  depth(12, 10) = std::numeric_limits<float>::infinity();
  depth(13, 10) = 1e-30F;
  RgbdCalibration calibration = same_cameras();
  calibration.depth_from_colour.translation = {0.1F, 0.0F, 0.1F};
  const Image<float> registered = register_image(depth, calibration);
  for (std::size_t i = 0; i < registered.size(); ++i) REQUIRE(registered.data()[i] == 0.0F);
}

}  // namespace
}  // namespace foothold::test

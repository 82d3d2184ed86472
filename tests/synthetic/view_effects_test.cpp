// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "foothold/synthetic/view_effects.h"

#include <cmath>

#include "foothold/base/error.h"
#include "support/catch.h"

namespace foothold {
namespace {

constexpr int kWidth = 160;
constexpr int kHeight = 120;
constexpr float kWall_m = 3.0F;

/// A wall with a checkerboard of dark and light squares, parallel to the image.
RgbdFrame wall() {
  RgbdFrame frame;
  frame.depth = Image<float>(kWidth, kHeight);
  frame.colour = Image<Rgb8>(kWidth, kHeight);
  const Intrinsics camera{146.25F, 146.25F, 79.5F, 59.5F};
  frame.calibration = {camera, camera, SE3{}};
  for (int v = 0; v < kHeight; ++v) {
    for (int u = 0; u < kWidth; ++u) {
      frame.depth(u, v) = kWall_m;
      const std::uint8_t grey = (u / 8 + v / 8) % 2 == 0 ? 60 : 180;
      frame.colour(u, v) = {grey, grey, grey};
    }
  }
  return frame;
}

RgbdFrame with(const ViewEffects& effects, std::uint64_t seed = 1, std::int64_t index = 0) {
  RgbdFrame frame = wall();
  frame.index = index;
  apply_effects(effects, seed, frame);
  return frame;
}

/// The share of pixels for which something holds.
template <class Condition>
double share(const Condition& condition) {
  int count = 0;
  for (int v = 0; v < kHeight; ++v) {
    for (int u = 0; u < kWidth; ++u) count += condition(u, v) ? 1 : 0;
  }
  return static_cast<double>(count) / (kWidth * kHeight);
}

TEST_CASE("apply_effects: no effect changes nothing") {
  const RgbdFrame before = wall();
  const RgbdFrame after = with({});
  REQUIRE(share([&](int u, int v) { return after.depth(u, v) == before.depth(u, v) && after.colour(u, v).g == before.colour(u, v).g; }) ==
          1.0);
}

TEST_CASE("apply_effects: exposure, gamma and warmth act on colour alone as defined") {
  ViewEffects effects;
  effects.exposure = 0.5F;
  REQUIRE(with(effects).colour(0, 0).g == 30);
  effects.warmth = 0.2F;
  REQUIRE(with(effects).colour(0, 0).r == 36);
  REQUIRE(with(effects).colour(0, 0).b == 24);
  effects = {};
  effects.gamma = 2.0F;
  REQUIRE(with(effects).colour(8, 0).g == 127);  // 255 (180 / 255)^2 = 127.06
  REQUIRE(with(effects).depth(8, 0) == kWall_m);
}

TEST_CASE("apply_effects: blur takes contrast away and keeps the mean") {
  ViewEffects effects;
  effects.blur_px = 64.0F;  // 16 px here: two squares
  const RgbdFrame frame = with(effects);
  double sum = 0.0;
  double sum2 = 0.0;
  for (std::size_t i = 0; i < frame.colour.size(); ++i) {
    sum += frame.colour.data()[i].g;
    sum2 += std::pow(frame.colour.data()[i].g, 2);
  }
  const auto n = static_cast<double>(frame.colour.size());
  REQUIRE(sum / n == Approx(120.0).margin(3.0));
  REQUIRE(std::sqrt(sum2 / n - sum * sum / n / n) < 40.0);  // 60 before
}

TEST_CASE("apply_effects: holes take the share of depth asked for, elsewhere in every frame") {
  ViewEffects effects;
  effects.holes = 0.4F;
  const RgbdFrame first = with(effects, 1, 0);
  const RgbdFrame second = with(effects, 1, 1);
  REQUIRE(share([&](int u, int v) { return first.depth(u, v) == 0.0F; }) == Approx(0.4).margin(0.01));
  REQUIRE(share([&](int u, int v) { return (first.depth(u, v) == 0.0F) != (second.depth(u, v) == 0.0F); }) > 0.2);
}

TEST_CASE("apply_effects: a person covers about the share asked for, and stands before what was seen") {
  for (const float wanted : {0.1F, 0.3F}) {
    ViewEffects effects;
    effects.person = wanted;
    const RgbdFrame frame = with(effects);
    const double covered = share([&](int u, int v) { return frame.depth(u, v) != kWall_m; });
    REQUIRE(covered > 0.5 * static_cast<double>(wanted));
    REQUIRE(covered < 1.6 * static_cast<double>(wanted));
    REQUIRE(share([&](int u, int v) { return frame.depth(u, v) > kWall_m; }) == 0.0);
  }
}

TEST_CASE("apply_effects: equal seeds and indices give equal frames, and values out of range are refused") {
  ViewEffects effects;
  effects.person = 0.2F;
  effects.holes = 0.2F;
  effects.blur_px = 8.0F;
  const RgbdFrame a = with(effects, 3, 7);
  const RgbdFrame b = with(effects, 3, 7);
  REQUIRE(share([&](int u, int v) { return a.depth(u, v) == b.depth(u, v) && a.colour(u, v).r == b.colour(u, v).r; }) == 1.0);
  effects.holes = 2.0F;
  REQUIRE_THROWS_AS(with(effects), InvalidSettings);
}

}  // namespace
}  // namespace foothold

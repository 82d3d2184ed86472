// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "spoilt_frame.h"

#include <algorithm>

#include "fake_sequence.h"
#include "support/catch.h"

namespace foothold {
namespace {

RgbdFrame spoilt(Spoilage spoilage) {
  RgbdFrame frame = test::FakeSequence("fake", 1).load(0);
  Random random(1, 2);
  spoil(frame, spoilage, random);
  return frame;
}

int brightest(const RgbdFrame& frame) {
  int result = 0;
  for (std::size_t i = 0; i < frame.colour.size(); ++i) result = std::max<int>(result, frame.colour.data()[i].r);
  return result;
}

TEST_CASE("spoil: darkness leaves the depth, a lens that is covered leaves nothing, noise leaves the colour") {
  const RgbdFrame good = spoilt(Spoilage::kNone);
  const RgbdFrame dark = spoilt(Spoilage::kDark);
  const RgbdFrame covered = spoilt(Spoilage::kCovered);
  const RgbdFrame noisy = spoilt(Spoilage::kNoise);
  REQUIRE(brightest(good) > 200);
  REQUIRE(brightest(dark) < 20);
  REQUIRE(brightest(covered) < 20);
  REQUIRE(brightest(noisy) == brightest(good));
  int num_lost = 0;
  int num_changed = 0;
  for (std::size_t i = 0; i < good.depth.size(); ++i) {
    REQUIRE(dark.depth.data()[i] == good.depth.data()[i]);
    REQUIRE(covered.depth.data()[i] < 1.0F);
    REQUIRE(covered.depth.data()[i] >= 0.0F);
    num_lost += noisy.depth.data()[i] == 0.0F ? 1 : 0;
    num_changed += noisy.depth.data()[i] != good.depth.data()[i] ? 1 : 0;
  }
  const auto num_pixels = static_cast<int>(good.depth.size());
  REQUIRE(num_lost > num_pixels / 4);
  REQUIRE(num_lost < num_pixels / 2);
  REQUIRE(num_changed > num_pixels * 9 / 10);
}

}  // namespace
}  // namespace foothold

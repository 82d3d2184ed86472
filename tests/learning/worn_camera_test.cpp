// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "worn_camera.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "fake_sequence.h"
#include "support/catch.h"

namespace foothold {
namespace {

RgbdFrame frame_of(float wear, std::uint64_t camera_seed, std::uint64_t frame_seed) {
  RgbdFrame frame = test::FakeSequence("fake", 1).load(0);
  Random of_camera(camera_seed, 1);
  Random of_frame(frame_seed, 2);
  WornCamera(wear, of_camera).wear(frame, of_frame);
  return frame;
}

template <class Pixel>
bool is_same(const Image<Pixel>& a, const Image<Pixel>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(Pixel)) == 0;
}

TEST_CASE("WornCamera: without wear frames stay as they are, with it both images change, the same for equal seeds") {
  const RgbdFrame fresh = test::FakeSequence("fake", 1).load(0);
  REQUIRE(is_same(frame_of(0.0F, 1, 2).depth, fresh.depth));
  REQUIRE(is_same(frame_of(0.0F, 1, 2).colour, fresh.colour));
  const RgbdFrame worn = frame_of(1.0F, 1, 2);
  REQUIRE_FALSE(is_same(worn.depth, fresh.depth));
  REQUIRE_FALSE(is_same(worn.colour, fresh.colour));
  REQUIRE(is_same(worn.depth, frame_of(1.0F, 1, 2).depth));
  REQUIRE(is_same(worn.colour, frame_of(1.0F, 1, 2).colour));
  REQUIRE_FALSE(is_same(worn.colour, frame_of(1.0F, 1, 3).colour));
}

TEST_CASE("WornCamera: invents no depth where there is none") {
  RgbdFrame frame = test::FakeSequence("fake", 1).load(0);
  std::fill(frame.depth.data(), frame.depth.data() + frame.depth.size(), 0.0F);
  Random random(1, 1);
  WornCamera(1.0F, random).wear(frame, random);
  REQUIRE(std::all_of(frame.depth.data(), frame.depth.data() + frame.depth.size(), [](float depth_m) { return depth_m == 0.0F; }));
}

TEST_CASE("add_strangers: only ever in front of what is there") {
  const RgbdFrame fresh = test::FakeSequence("fake", 1).load(0);
  int num_changed = 0;
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    RgbdFrame frame = fresh;
    Random random(seed, 3);
    add_strangers(frame, 0.5F, random);
    for (std::size_t i = 0; i < fresh.depth.size(); ++i) {
      REQUIRE(frame.depth.data()[i] <= fresh.depth.data()[i]);
      num_changed += frame.depth.data()[i] < fresh.depth.data()[i] ? 1 : 0;
    }
  }
  REQUIRE(num_changed > 0);
}

TEST_CASE("PoseDrift: stays within its bounds, varies slowly, and is nothing without amplitude") {
  Random random(1, 4);
  const PoseDrift drift(0.02F, 1.0F, random);
  const SE3 none = PoseDrift(0.0F, 0.0F, random).apply(SE3{}, 17);
  REQUIRE(translation_distance_m(none, SE3{}) < 1e-6F);
  // Along three axes at once; a sine with a period of at least 60 frames moves by at most 2 pi / 60 of its amplitude a frame.
  const float most_m = 0.02F * std::sqrt(3.0F) * 1.02F;
  float largest_m = 0.0F;
  for (int i = 0; i < 300; ++i) {
    const SE3 pose = drift.apply(SE3{}, i);
    REQUIRE(is_rigid(pose, 1e-4F));
    largest_m = std::max(largest_m, translation_distance_m(pose, SE3{}));
    REQUIRE(translation_distance_m(pose, drift.apply(SE3{}, i + 1)) < most_m * 6.2832F / 60.0F);
  }
  REQUIRE(largest_m < most_m);
  REQUIRE(largest_m > 0.01F);
}

}  // namespace
}  // namespace foothold

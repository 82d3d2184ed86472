// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "foothold/synthetic/synthetic_sequence.h"

#include <cmath>
#include <cstring>
#include <thread>
#include <vector>

#include "foothold/base/contract.h"
#include "foothold/base/error.h"
#include "foothold/synthetic/renderer.h"
#include "support/catch.h"

namespace foothold {
namespace {

std::unique_ptr<Sequence> open(const std::string& spec, int num_threads = 1) {
  ContextOptions options;
  options.num_threads = num_threads;
  return make_synthetic_sequence(parse_synthetic_spec(spec), Context(options));
}

bool equal(const RgbdFrame& a, const RgbdFrame& b) {
  return a.depth.size() == b.depth.size() && std::memcmp(a.depth.data(), b.depth.data(), a.depth.size() * sizeof(float)) == 0 &&
         std::memcmp(a.colour.data(), b.colour.data(), a.colour.size() * sizeof(Rgb8)) == 0 &&
         translation_distance_m(*a.world_from_camera, *b.world_from_camera) == 0.0F;
}

TEST_CASE("SyntheticSequence: frames are complete") {
  const auto sequence = open("synthetic:kitchen?frames=40&width=320&height=240");
  REQUIRE(sequence->name() == "synthetic:kitchen?frames=40&width=320&height=240");
  REQUIRE(sequence->num_frames() == 40);
  const RgbdFrame frame = sequence->load(30);
  REQUIRE(describe_frame_error(frame.view()).empty());
  REQUIRE(frame.depth.width() == 320);
  REQUIRE(frame.colour.height() == 240);
  REQUIRE(frame.index == 30);
  REQUIRE(frame.timestamp_s == Approx(1.0));
  REQUIRE(frame.world_from_camera.has_value());
  REQUIRE(frame.calibration.depth.fx == 292.5F);
  REQUIRE(frame.calibration.colour.cx == frame.calibration.depth.cx);
  REQUIRE(translation_distance_m(frame.calibration.depth_from_colour, SE3{}) == 0.0F);
  REQUIRE_THROWS_AS(sequence->load(40), ContractViolation);
  REQUIRE_THROWS_AS(sequence->load(-1), ContractViolation);
}

TEST_CASE("SyntheticSequence: the full size has the nominal calibration of 7-Scenes") {
  const RgbdFrame frame = open("stairs?frames=1")->load(0);
  REQUIRE(frame.depth.width() == 640);
  REQUIRE(frame.depth.height() == 480);
  REQUIRE(frame.calibration.depth.fx == 585.0F);
  REQUIRE(frame.calibration.depth.fy == 585.0F);
  REQUIRE(frame.calibration.depth.cx == 320.0F);
  REQUIRE(frame.calibration.depth.cy == 240.0F);
}

TEST_CASE("SyntheticSequence: without noise, depth and colour are those of the ray-caster") {
  const RgbdFrame frame = open("lounge?noise=0&width=160&height=120")->load(7);
  const RenderedView view = render(make_room("lounge"), frame.calibration.depth, *frame.world_from_camera, 160, 120);
  REQUIRE(std::memcmp(frame.depth.data(), view.depth.data(), view.depth.size() * sizeof(float)) == 0);
  REQUIRE(std::memcmp(frame.colour.data(), view.colour.data(), view.colour.size() * sizeof(Rgb8)) == 0);
}

TEST_CASE("SyntheticSequence: back-projected points of an exact frame lie on the room's surfaces") {
  const Room room = make_room("workshop");
  const RgbdFrame frame = open("workshop?noise=0&trajectory=test&roll_deg=35&width=160&height=120")->load(50);
  for (int v = 0; v < 120; v += 11) {
    for (int u = 0; u < 160; u += 11) {
      const Eigen::Vector3f point = frame.calibration.depth.back_project(static_cast<float>(u), static_cast<float>(v), frame.depth(u, v));
      REQUIRE(distance_to_surface(room, *frame.world_from_camera * point) < 1e-4F);
    }
  }
}

TEST_CASE("SyntheticSequence: the same frames on 1, 2 and 4 threads, in any order, loaded side by side") {
  const std::string spec = "synthetic:office?width=160&height=120&noise=2";
  const auto sequence = open(spec);
  const std::vector<int> indices{3, 250, 0, 77};
  std::vector<RgbdFrame> expected;
  for (const int i : indices) expected.push_back(sequence->load(i));
  for (const int num_threads : {1, 2, 4}) {
    const auto other = open(spec, num_threads);
    std::vector<RgbdFrame> frames(indices.size());
    std::vector<std::thread> threads;
    for (std::size_t k = 0; k < indices.size(); ++k) threads.emplace_back([&, k] { frames[k] = other->load(indices[k]); });
    for (std::thread& thread : threads) thread.join();
    for (std::size_t k = 0; k < indices.size(); ++k) REQUIRE(equal(frames[k], expected[k]));
  }
}

TEST_CASE("SyntheticSequence: a longer sequence begins with the shorter one") {
  REQUIRE(equal(open("training-2?frames=10&width=64&height=48")->load(9), open("training-2?frames=2000&width=64&height=48")->load(9)));
}

TEST_CASE("SyntheticSequence: seed and trajectory change what is seen") {
  const RgbdFrame frame = open("office?width=64&height=48")->load(5);
  REQUIRE_FALSE(equal(frame, open("office?width=64&height=48&seed=1")->load(5)));
  REQUIRE_FALSE(equal(frame, open("office?width=64&height=48&trajectory=test")->load(5)));
}

TEST_CASE("SyntheticSequence: roll turns the camera about its optical axis") {
  const SE3 upright = *open("office?width=64&height=48")->load(20).world_from_camera;
  const SE3 rolled = *open("office?width=64&height=48&roll_deg=90")->load(20).world_from_camera;
  REQUIRE(translation_distance_m(upright, rolled) == 0.0F);
  REQUIRE((upright.rotation.col(2) - rolled.rotation.col(2)).norm() < 1e-5F);
  // Clockwise by a quarter: the camera's x axis points where its y axis did.
  REQUIRE((rolled.rotation.col(0) - upright.rotation.col(1)).norm() < 1e-5F);
}

TEST_CASE("SyntheticSequence: noise leaves most of the depth, near the truth") {
  const RgbdFrame exact = open("kitchen?noise=0&width=320&height=240")->load(60);
  const RgbdFrame noisy = open("kitchen?noise=1&width=320&height=240")->load(60);
  int num_valid = 0;
  int num_near = 0;
  for (std::size_t i = 0; i < exact.depth.size(); ++i) {
    const float z = noisy.depth.data()[i];
    if (z <= 0.0F) continue;
    ++num_valid;
    num_near += std::fabs(z - exact.depth.data()[i]) < 0.01F * z * z + 0.005F ? 1 : 0;
  }
  REQUIRE(num_valid > 0.75 * 320 * 240);
  REQUIRE(num_near > 0.95 * num_valid);
}

TEST_CASE("make_synthetic_sequence: refuses settings out of range") {
  SyntheticSequenceSettings settings;
  settings.frames = 0;
  REQUIRE_THROWS_AS(make_synthetic_sequence(settings, Context()), InvalidSettings);
  settings = {};
  settings.room = "attic";
  REQUIRE_THROWS_AS(make_synthetic_sequence(settings, Context()), InvalidSettings);
  settings = {};
  settings.trajectory = "both";
  REQUIRE_THROWS_AS(make_synthetic_sequence(settings, Context()), InvalidSettings);
}

}  // namespace
}  // namespace foothold

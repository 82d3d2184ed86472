// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "foothold/relocalisation/forest_relocaliser.h"

#include <functional>
#include <limits>
#include <sstream>
#include <utility>
#include <vector>

#include "foothold/base/error.h"
#include "relocalisation/scenes.h"
#include "support/catch.h"
#include "support/error_message.h"

namespace foothold {
namespace {

using test::bit_equal;
using test::office;
using test::saved;
using test::trained;
using test::untrained;

constexpr float kFiveDegrees = 0.0872665F;

bool is_right(const PoseEstimate& estimate, const SE3& truth) {
  return translation_distance_m(estimate.world_from_camera, truth) < 0.05F &&
         rotation_distance_rad(estimate.world_from_camera, truth) < kFiveDegrees;
}

/// A frame with the given depth everywhere.
RgbdFrame flat_frame(float depth_m, int width = 320, int height = 240) {
  RgbdFrame frame;
  frame.depth = Image<float>(width, height, depth_m);
  frame.colour = Image<Rgb8>(width, height, {128, 128, 128});
  frame.calibration = office()[0].calibration;
  return frame;
}

TEST_CASE("ForestRelocaliser: knows nothing before training") {
  ForestRelocaliser relocaliser = untrained();
  REQUIRE(relocaliser.relocalise(office()[0].view()).empty());
  REQUIRE_NOTHROW(relocaliser.update());
  REQUIRE(relocaliser.relocalise(office()[0].view()).empty());
}

TEST_CASE("ForestRelocaliser: finds frames between those it was trained on, to 5 cm and 5 degrees") {
  ForestRelocaliser relocaliser = trained();
  int num_right = 0;
  int num_tested = 0;
  for (std::size_t i = 0; i < office().size(); ++i) {
    if (test::is_training_frame(i)) continue;
    ++num_tested;
    const auto estimates = relocaliser.relocalise(office()[i].view());
    for (std::size_t k = 0; k < estimates.size(); ++k) {
      REQUIRE(is_rigid(estimates[k].world_from_camera, 1e-5F));
      REQUIRE(estimates[k].confidence >= 0.0F);
      REQUIRE(estimates[k].confidence <= estimates[0].confidence);
    }
    REQUIRE(estimates.size() <= 16);
    num_right += !estimates.empty() && is_right(estimates[0], *office()[i].world_from_camera) ? 1 : 0;
  }
  REQUIRE(num_tested == 20);
  INFO(num_right << " of " << num_tested);
  REQUIRE(num_right >= 18);
}

TEST_CASE("ForestRelocaliser: a camera lost a moment ago is found where tracking ended, though the tracker had drifted") {
  ForestRelocaliser relocaliser = trained();
  SE3 drift;
  drift.translation = {0.015F, -0.01F, 0.015F};
  relocaliser.train(office()[20].view(), drift * *office()[20].world_from_camera);
  const auto estimates = relocaliser.relocalise(office()[20].view());
  REQUIRE_FALSE(estimates.empty());
  REQUIRE(translation_distance_m(estimates[0].world_from_camera, drift * *office()[20].world_from_camera) < 0.006F);
  // Where the last camera did not look, what was learnt before counts.
  REQUIRE(translation_distance_m(relocaliser.relocalise(office()[1].view())[0].world_from_camera, *office()[1].world_from_camera) < 0.015F);
}

TEST_CASE("ForestRelocaliser: a scene far from the world's origin is found as well") {
  ForestRelocaliser relocaliser = untrained();
  SE3 elsewhere;
  elsewhere.translation = {250.0F, -130.0F, 40.0F};
  for (std::size_t i = 0; i < 20; i += 2) relocaliser.train(office()[i].view(), elsewhere * *office()[i].world_from_camera);
  int num_right = 0;
  for (std::size_t i = 1; i < 19; i += 4) {
    const auto estimates = relocaliser.relocalise(office()[i].view());
    num_right += !estimates.empty() && is_right(estimates[0], elsewhere * *office()[i].world_from_camera) ? 1 : 0;
  }
  REQUIRE(num_right >= 4);
}

TEST_CASE("ForestRelocaliser: blank depth proposes nothing and teaches nothing") {
  ForestRelocaliser relocaliser = trained();
  ForestRelocaliser fresh = untrained();
  for (const float hole : {0.0F, -1.0F, std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()}) {
    const RgbdFrame blank = flat_frame(hole);
    REQUIRE(relocaliser.relocalise(blank.view()).empty());
    fresh.train(blank.view(), SE3{});
    REQUIRE(fresh.relocalise(office()[0].view()).empty());
  }
  REQUIRE(fresh.state_bytes() == untrained().state_bytes());
}

TEST_CASE("ForestRelocaliser: frames smaller than a feature's block propose nothing and teach nothing") {
  ForestRelocaliser relocaliser = trained();
  const std::string before = saved(relocaliser);
  for (const auto& [width, height] : {std::pair{1, 1}, std::pair{1, 240}, std::pair{320, 1}}) {
    const RgbdFrame tiny = flat_frame(2.0F, width, height);
    REQUIRE(relocaliser.relocalise(tiny.view()).empty());
    relocaliser.train(tiny.view(), SE3{});
  }
  relocaliser.update();
  const ForestRelocaliser other = trained();
  REQUIRE(relocaliser.state_bytes() >= other.state_bytes());
}

TEST_CASE("ForestRelocaliser: colour with a fourth byte gives the same answers") {
  ForestRelocaliser relocaliser = trained();
  const RgbdFrame& frame = office()[7];
  std::vector<std::uint8_t> rgba;
  for (std::size_t i = 0; i < frame.colour.size(); ++i) {
    const Rgb8 pixel = frame.colour.data()[i];
    for (const std::uint8_t byte : {pixel.r, pixel.g, pixel.b, static_cast<std::uint8_t>(i)}) rgba.push_back(byte);
  }
  Frame view = frame.view();
  view.colour.data = rgba.data();
  view.colour.bytes_per_pixel = 4;
  REQUIRE(bit_equal(relocaliser.relocalise(view), relocaliser.relocalise(frame.view())));
}

TEST_CASE("ForestRelocaliser: the same scene and answers on 1, 2 and 4 threads") {
  constexpr std::size_t kFrames = 14;
  ForestRelocaliser one = untrained(1);
  test::train_on(one, kFrames);
  one.update();
  const std::string expected = saved(one);
  for (const int num_threads : {2, 4}) {
    ForestRelocaliser several = untrained(num_threads);
    test::train_on(several, kFrames);
    several.update();
    REQUIRE(several.state_bytes() == one.state_bytes());
    REQUIRE((saved(several) == expected));
    for (const std::size_t i : {1U, 5U, 9U, 39U}) {
      REQUIRE(bit_equal(several.relocalise(office()[i].view()), one.relocalise(office()[i].view())));
    }
  }
}

TEST_CASE("ForestRelocaliser: an answer depends on scene and frame only, not on what was asked before") {
  ForestRelocaliser relocaliser = trained();
  const std::string before = saved(relocaliser);
  const auto first = relocaliser.relocalise(office()[3].view());
  relocaliser.relocalise(office()[21].view());
  REQUIRE(bit_equal(relocaliser.relocalise(office()[3].view()), first));
  REQUIRE((saved(relocaliser) == before));
}

TEST_CASE("ForestRelocaliser: a copy goes its own way") {
  ForestRelocaliser original = untrained();
  test::train_on(original, 8);
  const std::string before = saved(original);
  ForestRelocaliser copy = original;
  REQUIRE((saved(copy) == before));
  REQUIRE(bit_equal(copy.relocalise(office()[3].view()), original.relocalise(office()[3].view())));
  copy.train(office()[30].view(), *office()[30].world_from_camera);
  REQUIRE((saved(original) == before));
  const std::string grown = saved(copy);
  REQUIRE((grown != before));
  original.train(office()[30].view(), *office()[30].world_from_camera);
  REQUIRE((saved(original) == grown));
  original.reset();
  REQUIRE((saved(copy) == grown));
  original = copy;
  REQUIRE((saved(original) == grown));
  ForestRelocaliser moved = std::move(copy);
  REQUIRE((saved(moved) == grown));
}

TEST_CASE("ForestRelocaliser: what was moved from may be assigned to, and refuses everything else") {
  ForestRelocaliser source = untrained();
  ForestRelocaliser target = std::move(source);
  const RgbdFrame& frame = office()[0];
  std::stringstream stream;
  const std::vector<std::function<void()>> uses = {[&] { source.train(frame.view(), *frame.world_from_camera); },
                                                   [&] { source.relocalise(frame.view()); },
                                                   [&] { source.explain(frame.view()); },
                                                   [&] { source.update(); },
                                                   [&] { source.reset(); },
                                                   [&] { source.state_bytes(); },
                                                   [&] { source.acceptance_threshold(); },
                                                   [&] { source.save(stream); },
                                                   [&] { source.load(stream); },
                                                   [&] { source.forest(); },
                                                   [&] { source.settings(); },
                                                   [&] { const ForestRelocaliser copy(source); },
                                                   [&] { target = std::as_const(source); }};
  for (const std::function<void()>& use : uses) {
    REQUIRE(test::contains(test::error_message<ContractViolation>(use), "moved_from"));
  }
  source = target;
  REQUIRE((saved(source) == saved(target)));
}

TEST_CASE("ForestRelocaliser: reset forgets the scene, and training starts afresh") {
  ForestRelocaliser relocaliser = untrained();
  const std::size_t empty = relocaliser.state_bytes();
  test::train_on(relocaliser, 8);
  REQUIRE(relocaliser.state_bytes() > empty);
  const std::string first = saved(relocaliser);
  relocaliser.reset();
  REQUIRE(relocaliser.state_bytes() == empty);
  REQUIRE(relocaliser.relocalise(office()[0].view()).empty());
  REQUIRE((saved(relocaliser) == saved(untrained())));
  test::train_on(relocaliser, 8);
  REQUIRE((saved(relocaliser) == first));
}

TEST_CASE("ForestRelocaliser: rejects callers' mistakes") {
  ForestRelocaliser relocaliser = untrained();
  const Frame good = office()[0].view();
  const SE3 pose = *office()[0].world_from_camera;
  const auto require_refused = [&](const Frame& frame, const SE3& world_from_camera) {
    REQUIRE_THROWS_AS(relocaliser.train(frame, world_from_camera), ContractViolation);
  };
  Frame frame = good;
  frame.colour.width /= 2;
  require_refused(frame, pose);
  REQUIRE_THROWS_AS(relocaliser.relocalise(frame), ContractViolation);
  frame = good;
  frame.depth.data = nullptr;
  require_refused(frame, pose);
  REQUIRE_THROWS_AS(relocaliser.relocalise(frame), ContractViolation);
  frame = good;
  frame.calibration.depth.fx = 0.0F;
  require_refused(frame, pose);
  REQUIRE_THROWS_AS(relocaliser.relocalise(frame), ContractViolation);
  frame = good;
  frame.depth.memory = frame.colour.memory = MemoryKind::kCuda;
  require_refused(frame, pose);
  REQUIRE_THROWS_AS(relocaliser.relocalise(frame), ContractViolation);

  SE3 bad = pose;
  bad.rotation *= 1.1F;
  require_refused(good, bad);
  bad = pose;
  bad.rotation.col(0) *= -1.0F;  // a reflection
  require_refused(good, bad);
  bad = pose;
  bad.translation.x() = std::numeric_limits<float>::quiet_NaN();
  require_refused(good, bad);
  REQUIRE((saved(relocaliser) == saved(untrained())));
}

TEST_CASE("ForestRelocaliser: refuses settings out of range, and knows its own") {
  ForestRelocaliserSettings settings = test::small_settings();
  settings.pose.num_hypotheses = 3;
  REQUIRE_THROWS_AS(ForestRelocaliser(test::context_of(1), test::small_forest(), settings), InvalidSettings);
  settings.pose.num_hypotheses = 64;
  settings.acceptance_threshold = 0.25F;
  const ForestRelocaliser relocaliser(test::context_of(1), test::small_forest(), settings);
  REQUIRE(relocaliser.settings().pose.num_hypotheses == 64);
  REQUIRE(relocaliser.acceptance_threshold() == 0.25F);
  REQUIRE(relocaliser.forest().fingerprint() == test::small_forest().fingerprint());
}

TEST_CASE("ForestRelocaliser: the preset 'paper' relocalises too") {
  ForestRelocaliserSettings settings = ForestRelocaliserSettings::preset("paper");
  settings.clustering.leaves_per_frame = 2560;  // the round robin's whole tour, as there are few frames
  ForestRelocaliser relocaliser(test::context_of(1), test::small_forest(), settings);
  test::train_on(relocaliser, 8);
  int num_right = 0;
  for (const std::size_t i : {1U, 3U, 5U}) {
    const auto estimates = relocaliser.relocalise(office()[i].view());
    num_right += !estimates.empty() && is_right(estimates[0], *office()[i].world_from_camera) ? 1 : 0;
  }
  REQUIRE(num_right >= 2);
}

}  // namespace
}  // namespace foothold

// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// What a scene leaves out, and that it says so: memory_budget_mb, and points that a place has no coordinates for.
#include "places/scene_limits.h"

#include <sstream>
#include <string>
#include <vector>

#include "relocalisation/scenes.h"
#include "support/catch.h"
#include "support/error_message.h"
#include "support/logged_warnings.h"

namespace foothold {
namespace {

using test::LoggedWarnings;
using test::office;

constexpr std::size_t kMegabyte = 1000000;

SceneLimits limits_of(int budget_mb, int examples_per_view) {
  ForestRelocaliserSettings settings;
  settings.memory_budget_mb = budget_mb;
  settings.reservoirs.examples_per_view = examples_per_view;
  return SceneLimits(settings);
}

TEST_CASE("SceneLimits: all is learnt until detail must go, then little, and nothing where no detail is left, and each is said once") {
  LoggedWarnings log;
  const Context context = log.context();
  SceneLimits limits = limits_of(80, 255);
  REQUIRE(limits.bounds_memory());
  REQUIRE_FALSE(limits.is_full(70 * kMegabyte - 1));
  REQUIRE(limits.is_full(70 * kMegabyte));
  REQUIRE(limits.detail(context, 0, 1) == Detail::kFull);
  REQUIRE(limits.detail(context, 70 * kMegabyte - 1, 2) == Detail::kFull);
  REQUIRE(log.warnings.empty());
  for (const std::int64_t frame : {3, 4}) {
    limits.watch_thinning(context, 71 * kMegabyte, frame);
    REQUIRE(limits.detail(context, 60 * kMegabyte, frame) == Detail::kSparse);
  }
  REQUIRE(log.warnings.size() == 1);
  REQUIRE(test::contains(log.warnings[0], "frame 3: the relocaliser's scene holds 71 MB, and memory_budget_mb is 80"));
  REQUIRE(test::contains(log.warnings[0], "at most 16 examples of a view"));
  for (const std::int64_t frame : {6, 7}) REQUIRE(limits.detail(context, 70 * kMegabyte, frame) == Detail::kNone);
  REQUIRE(log.warnings.size() == 2);
  REQUIRE(test::contains(log.warnings[1], "frame 6: the relocaliser's scene holds 70 MB, and memory_budget_mb is 80"));
  REQUIRE(test::contains(log.warnings[1], "nothing is learnt"));
  REQUIRE(limits.detail(context, 60 * kMegabyte, 8) == Detail::kSparse);
}

TEST_CASE("SceneLimits: sparse is never more than full") {
  REQUIRE(limits_of(80, 255).examples_per_view(Detail::kFull) == 255);
  REQUIRE(limits_of(80, 255).examples_per_view(Detail::kSparse) == kSparseExamplesPerView);
  REQUIRE(limits_of(80, 0).examples_per_view(Detail::kFull) == 0);
  REQUIRE(limits_of(80, 0).examples_per_view(Detail::kSparse) == kSparseExamplesPerView);
  REQUIRE(limits_of(80, 8).examples_per_view(Detail::kSparse) == 8);
}

TEST_CASE("SceneLimits: without a budget all is learnt") {
  LoggedWarnings log;
  SceneLimits limits = limits_of(0, 255);
  REQUIRE_FALSE(limits.bounds_memory());
  REQUIRE_FALSE(limits.is_full(1000000 * kMegabyte));
  REQUIRE(limits.detail(log.context(), 1000000 * kMegabyte, 1) == Detail::kFull);
  REQUIRE(log.warnings.empty());
}

TEST_CASE("SceneLimits: points beyond a place's coordinates are said once, stray ones are not") {
  LoggedWarnings log;
  const Context context = log.context();
  SceneLimits limits = limits_of(0, 255);
  limits.watch_reach(context, 0, 0, 1);
  limits.watch_reach(context, 10, 1000, 2);
  REQUIRE(log.warnings.empty());
  for (const std::int64_t frame : {3, 4}) limits.watch_reach(context, 250, 1000, frame);
  REQUIRE(log.warnings.size() == 1);
  REQUIRE(test::contains(log.warnings[0], "frame 3: 25 % of it lies more than 33 m from where its place began, and is not learnt"));
}

ForestRelocaliserSettings with_budget(int budget_mb) {
  ForestRelocaliserSettings settings = test::small_settings();
  settings.memory_budget_mb = budget_mb;
  return settings;
}

SE3 moved(const SE3& pose, float x_m) { return {pose.rotation, pose.translation + Eigen::Vector3f(x_m, 0.0F, 0.0F)}; }

/// Learns the office again and again, each time elsewhere.
void learn_offices(ForestRelocaliser& relocaliser, int count) {
  for (int i = 0; i < count; ++i) {
    for (std::size_t k = 0; k < office().size(); k += 2)
      relocaliser.train(office()[k].view(), moved(*office()[k].world_from_camera, 20.0F * static_cast<float>(i)));
    for (int k = 0; k < 30; ++k) relocaliser.update();
  }
}

TEST_CASE("memory_budget_mb: bounds the scene, whatever the number of threads, and is said once for each of two limits") {
  constexpr int kBudgetMb = 8;
  std::string scenes[2];
  for (int i = 0; i < 2; ++i) {
    LoggedWarnings log;
    ForestRelocaliser relocaliser(log.context(1 + 2 * i), test::small_forest(), with_budget(kBudgetMb));
    learn_offices(relocaliser, 8);
    INFO(relocaliser.state_bytes());
    CHECK(relocaliser.state_bytes() <= kBudgetMb * kMegabyte);
    REQUIRE(log.warnings.size() == 2);
    CHECK(test::contains(log.warnings[0], "memory_budget_mb is 8"));
    CHECK(test::contains(log.warnings[0], "16 examples of a view"));
    CHECK(test::contains(log.warnings[1], "nothing is learnt"));
    scenes[i] = test::saved(relocaliser);
    learn_offices(relocaliser, 1);
    CHECK((test::saved(relocaliser) == scenes[i]));
    CHECK(log.warnings.size() == 2);
    relocaliser.reset();
    learn_offices(relocaliser, 1);
    CHECK(relocaliser.state_bytes() > kMegabyte);
  }
  CHECK((scenes[0] == scenes[1]));
}

/// Every other of these frames is learnt, the others are tested.
std::vector<RgbdFrame> lounge() {
  const auto sequence = make_synthetic_sequence(parse_synthetic_spec("synthetic:lounge?frames=160&width=320&height=240"), Context());
  std::vector<RgbdFrame> frames;
  for (int i = 0; i < sequence->num_frames(); i += 4) frames.push_back(sequence->load(i));
  return frames;
}

/// How many of every other frame, from the second on, are found where they were learnt.
int num_found(ForestRelocaliser& relocaliser, const std::vector<RgbdFrame>& frames, float aside_m) {
  int count = 0;
  for (std::size_t i = 1; i < frames.size(); i += 2) {
    const auto estimates = relocaliser.relocalise(frames[i].view());
    const SE3 expected = moved(*frames[i].world_from_camera, aside_m);
    count += !estimates.empty() && translation_distance_m(estimates[0].world_from_camera, expected) < 0.05F ? 1 : 0;
  }
  return count;
}

TEST_CASE("memory_budget_mb: detail of rooms makes room for another, and all are found") {
  constexpr int kBudgetMb = 4;
  constexpr float kAside_m = -20.0F;
  const std::vector<RgbdFrame> frames = lounge();
  for (const bool is_bounded : {false, true}) {
    LoggedWarnings log;
    ForestRelocaliser relocaliser(log.context(), test::small_forest(), with_budget(is_bounded ? kBudgetMb : 0));
    learn_offices(relocaliser, 2);
    for (std::size_t i = 0; i < frames.size(); i += 2) relocaliser.train(frames[i].view(), moved(*frames[i].world_from_camera, kAside_m));
    for (int i = 0; i < 30; ++i) relocaliser.update();
    INFO(relocaliser.state_bytes() << " bytes");
    CHECK((relocaliser.state_bytes() <= kBudgetMb * kMegabyte) == is_bounded);
    CHECK(log.warnings.size() == (is_bounded ? 1 : 0));                                             // detail went, places did not
    CHECK(num_found(relocaliser, frames, kAside_m) >= 18);                                          // of 20
    CHECK(num_found(relocaliser, office(), 0.0F) + num_found(relocaliser, office(), 20.0F) >= 18);  // the two are equal
  }
}

TEST_CASE("memory_budget_mb: a loaded scene that is too large is thinned when something is to be learnt") {
  ForestRelocaliser unbounded = test::untrained();
  learn_offices(unbounded, 2);
  LoggedWarnings log;
  ForestRelocaliser relocaliser(log.context(), test::small_forest(), with_budget(1));
  std::stringstream stream(test::saved(unbounded));
  relocaliser.load(stream);
  REQUIRE(log.warnings.empty());  // nothing was left out
  REQUIRE(relocaliser.state_bytes() == unbounded.state_bytes());
  for (std::size_t k = 0; k < 8; ++k) relocaliser.train(office()[k].view(), moved(*office()[k].world_from_camera, 60.0F));
  INFO(relocaliser.state_bytes() << " bytes");
  CHECK(3 * relocaliser.state_bytes() < 2 * unbounded.state_bytes());
  CHECK(log.warnings.size() == 2);
  const std::string scene = test::saved(relocaliser);
  relocaliser.train(office()[8].view(), moved(*office()[8].world_from_camera, 80.0F));
  CHECK((test::saved(relocaliser) == scene));
}

TEST_CASE("ForestRelocaliser: warns once of what lies beyond a place's coordinates") {
  LoggedWarnings log;
  ForestRelocaliser relocaliser(log.context(), test::small_forest(), test::small_settings());
  relocaliser.train(office()[0].view(), *office()[0].world_from_camera);
  REQUIRE(log.warnings.empty());
  RgbdFrame far = office()[1];
  for (int v = 0; v < far.depth.height() / 4; ++v) {
    for (int u = 0; u < far.depth.width(); ++u) far.depth(u, v) = 60.0F;
  }
  for (int i = 0; i < 2; ++i) relocaliser.train(far.view(), *far.world_from_camera);
  REQUIRE(log.warnings.size() == 1);
  REQUIRE(test::contains(log.warnings[0], "25 % of it lies more than 33 m from where its place began"));
}

}  // namespace
}  // namespace foothold

// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// Cameras rolled about their optical axis, in a scene that was learnt upright.
#include <algorithm>
#include <cstdlib>
#include <string>

#include "relocalisation/inliers.h"
#include "relocalisation/scenes.h"
#include "support/catch.h"

namespace foothold {
namespace {

using test::bit_equal;
using test::is_training_frame;

constexpr float kFiveDegrees = 0.0872665F;

/// Views of the office between those it was learnt from, by a rolled camera.
std::vector<RgbdFrame> rolled_views(int roll_deg) {
  const std::string spec = "synthetic:office?frames=160&width=320&height=240&roll_deg=" + std::to_string(roll_deg);
  const auto sequence = make_synthetic_sequence(parse_synthetic_spec(spec), test::context_of(1));
  std::vector<RgbdFrame> views;
  for (int i = 4; i < sequence->num_frames(); i += 16) views.push_back(sequence->load(i));
  return views;
}

/// Has learnt the office upright, and tries so many rolls.
ForestRelocaliser trained(int num_rolls, const Context& context = test::context_of(1), float max_relocalise_ms = 0.0F) {
  ForestRelocaliserSettings settings = test::small_settings();
  settings.num_rolls = num_rolls;
  settings.max_relocalise_ms = max_relocalise_ms;
  ForestRelocaliser relocaliser(context, test::small_forest(), settings);
  std::istringstream scene(test::saved(test::trained()));
  relocaliser.load(scene);  // a scene is the same whatever rolls are tried in it
  return relocaliser;
}

int num_found(ForestRelocaliser relocaliser, const std::vector<RgbdFrame>& views) {
  int num = 0;
  for (const RgbdFrame& view : views) {
    const std::vector<PoseEstimate> estimates = relocaliser.relocalise(view.view());
    if (estimates.empty()) continue;
    const SE3& estimate = estimates.front().world_from_camera;
    const bool found = translation_distance_m(estimate, *view.world_from_camera) < 0.05F &&
                       rotation_distance_rad(estimate, *view.world_from_camera) < kFiveDegrees;
    num += found ? 1 : 0;
  }
  return num;
}

TEST_CASE("rolled views: found whatever the roll, if rolls are tried, and seldom otherwise") {
  for (const int roll_deg : {60, 90, -110, 180}) {
    const std::vector<RgbdFrame> views = rolled_views(roll_deg);
    REQUIRE(views.size() == 10);
    const int upright_only = num_found(trained(1), views);
    const int with_rolls = num_found(trained(8), views);
    INFO("rolled by " << roll_deg << " deg: " << upright_only << " found upright, " << with_rolls << " with rolls");
    CHECK(with_rolls >= 9);
    CHECK(upright_only <= (std::abs(roll_deg) >= 90 ? with_rolls / 2 : with_rolls - 2));
  }
}

TEST_CASE("max_relocalise_ms: when time is up, the answer is the best so far: that of the upright camera") {
  constexpr float kNextToNothing_ms = 1e-3F;
  constexpr float kPlenty_ms = 1e6F;
  const Context context = test::context_of(1);
  for (const RgbdFrame& view : rolled_views(90)) {
    const auto answer = [&](int num_rolls, float max_ms) { return trained(num_rolls, context, max_ms).relocalise(view.view()); };
    REQUIRE(bit_equal(answer(8, kNextToNothing_ms), answer(1, 0.0F)));
    REQUIRE(bit_equal(answer(8, kPlenty_ms), answer(8, 0.0F)));
  }
}

TEST_CASE("rolled views: the same answers on 1, 2 and 4 threads") {
  const std::vector<RgbdFrame> views = rolled_views(90);
  for (const int num_threads : {2, 4}) {
    ForestRelocaliser one = trained(8);
    ForestRelocaliser several = trained(8, test::context_of(num_threads));
    for (const std::size_t i : {0U, 4U, 8U}) REQUIRE(bit_equal(several.relocalise(views[i].view()), one.relocalise(views[i].view())));
  }
}

TEST_CASE("rolled views: an upright view that is surely found is answered as without rolls") {
  ForestRelocaliserSettings settings = test::small_settings();
  settings.sure_confidence = 0.0F;
  ForestRelocaliser any_is_sure(test::context_of(1), test::small_forest(), settings);
  std::istringstream scene(test::saved(test::trained()));
  any_is_sure.load(scene);
  ForestRelocaliser upright_only = trained(1);
  for (const std::size_t i : {1U, 21U}) {
    const Frame frame = test::office()[i].view();
    REQUIRE(bit_equal(any_is_sure.relocalise(frame), upright_only.relocalise(frame)));
  }
}

TEST_CASE("rolled views: more rolls never answer with less confidence") {
  ForestRelocaliser one = trained(1);
  ForestRelocaliser two = trained(2);
  ForestRelocaliser eight = trained(8);
  for (const RgbdFrame& view : rolled_views(30)) {
    const auto confidence = [&](ForestRelocaliser& relocaliser) {
      const std::vector<PoseEstimate> estimates = relocaliser.relocalise(view.view());
      return estimates.empty() ? 0.0F : estimates.front().confidence;
    };
    const float upright_only = confidence(one);
    REQUIRE(confidence(two) >= upright_only);
    REQUIRE(confidence(eight) >= upright_only);
  }
}

/// The number of rolls that are tried to find the camera of a view among eight.
int num_tried(const Frame& frame) {
  Trace trace;
  ContextOptions options;
  options.trace = &trace;
  trained(8, Context(options)).relocalise(frame);
  const auto count = [&](const char* stage) {
    return trace.stages().count(stage) == 0 ? 0 : static_cast<int>(trace.stages().at(stage).size());
  };
  return std::max(count("relocalise/trial"), count("relocalise/hypotheses"));  // a view that seems unfamiliar is tried before each search
}

TEST_CASE("rolled views: the right roll is tried early, and one that cannot be right is not tried") {
  for (const int roll_deg : {-90, 180}) {
    for (const RgbdFrame& view : rolled_views(roll_deg)) {
      INFO("rolled by " << roll_deg << " deg, frame " << view.index);
      CHECK(num_tried(view.view()) <= 3);
    }
  }
  RgbdFrame nowhere = test::office()[1];
  for (int v = 0; v < nowhere.depth.height(); ++v) {
    for (int u = 0; u < nowhere.depth.width(); ++u) nowhere.depth(u, v) = 9.0F;  // a wall that is further away than any in the office
  }
  CHECK(num_tried(nowhere.view()) == 1);
}

TEST_CASE("rolled views: explain() tells of the roll that answered") {
  ForestRelocaliser relocaliser = trained(8);
  const std::vector<RgbdFrame> views = rolled_views(90);
  for (const RgbdFrame& view : {views[0], views[5]}) {
    const std::vector<PoseEstimate> estimates = relocaliser.relocalise(view.view());
    const Explanation explanation = relocaliser.explain(view.view());
    REQUIRE(!estimates.empty());
    REQUIRE(explanation.candidates.size() == estimates.size());
    test::require_accounted_for(explanation, relocaliser.settings());
  }
}

}  // namespace
}  // namespace foothold

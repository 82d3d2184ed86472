// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// Views in a light that was not there when the scene was learnt.
#include <vector>

#include "foothold/synthetic/view_effects.h"
#include "relocalisation/scenes.h"
#include "support/catch.h"

namespace foothold {
namespace {

using test::office;

RgbdFrame exposed(const RgbdFrame& frame, float exposure) {
  RgbdFrame result = frame;
  ViewEffects effects;
  effects.exposure = exposure;
  apply_effects(effects, 1, result);
  return result;
}

/// Frames of a kitchen, eight apart.
std::vector<RgbdFrame> kitchen(const std::string& trajectory) {
  const auto sequence = make_synthetic_sequence(
      parse_synthetic_spec("synthetic:kitchen?frames=240&width=320&height=240&trajectory=" + trajectory), test::context_of(1));
  std::vector<RgbdFrame> frames;
  for (int i = 0; i < sequence->num_frames(); i += 8) frames.push_back(sequence->load(i));
  return frames;
}

/// Has learnt the kitchen with the default forest.
ForestRelocaliser taught(int num_threads) {
  ForestRelocaliser relocaliser(test::context_of(num_threads));
  for (const RgbdFrame& frame : kitchen("train")) relocaliser.train(frame.view(), *frame.world_from_camera);
  for (int i = 0; i < 30; ++i) relocaliser.update();
  return relocaliser;
}

/// Of views along another path, those that are found and believed.
int num_believed(ForestRelocaliser& relocaliser, const std::vector<RgbdFrame>& views, float exposure) {
  int count = 0;
  for (const RgbdFrame& view : views) {
    const auto estimates = relocaliser.relocalise(exposed(view, exposure).view());
    const bool is_right = !estimates.empty() && translation_distance_m(estimates.front().world_from_camera, *view.world_from_camera) < 0.1F;
    count += is_right && estimates.front().confidence >= relocaliser.acceptance_threshold() ? 1 : 0;
  }
  return count;
}

TEST_CASE("other lights: views that are much darker or brighter than what was learnt are found and believed as well") {
  ForestRelocaliser relocaliser = taught(1);
  const std::vector<RgbdFrame> views = kitchen("test");
  const int as_learnt = num_believed(relocaliser, views, 1.0F);
  REQUIRE(as_learnt >= 28);  // of 30
  CHECK(num_believed(relocaliser, views, 0.4F) >= as_learnt - 2);
  CHECK(num_believed(relocaliser, views, 1.8F) >= as_learnt - 5);  // white has no colour left
}

TEST_CASE("other lights: the same answers on 1, 2 and 4 threads, and asked again") {
  ForestRelocaliser one = taught(1);
  const RgbdFrame view = exposed(office()[1], 0.4F);
  const auto expected = one.relocalise(view.view());
  REQUIRE(test::bit_equal(one.relocalise(view.view()), expected));
  for (const int num_threads : {2, 4}) {
    ForestRelocaliser several = taught(num_threads);
    REQUIRE(test::bit_equal(several.relocalise(view.view()), expected));
  }
}

}  // namespace
}  // namespace foothold

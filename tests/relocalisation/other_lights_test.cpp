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

/// Of six views between those that were learnt, those that are found and believed.
int num_believed(ForestRelocaliser relocaliser, float exposure) {
  int count = 0;
  for (std::size_t i = 1; i < office().size() && i < 36; i += 3) {
    if (test::is_training_frame(i)) continue;
    const auto estimates = relocaliser.relocalise(exposed(office()[i], exposure).view());
    const bool is_right =
        !estimates.empty() && translation_distance_m(estimates.front().world_from_camera, *office()[i].world_from_camera) < 0.05F;
    count += is_right && estimates.front().confidence >= relocaliser.acceptance_threshold() ? 1 : 0;
  }
  return count;
}

TEST_CASE("other lights: views that are much darker or brighter than what was learnt are found and believed as well") {
  const int as_learnt = num_believed(test::trained(), 1.0F);
  REQUIRE(as_learnt >= 5);
  CHECK(num_believed(test::trained(), 0.4F) >= as_learnt - 1);
  CHECK(num_believed(test::trained(), 1.6F) >= as_learnt - 1);
}

TEST_CASE("other lights: the same answers on 1, 2 and 4 threads, and asked again") {
  ForestRelocaliser one = test::trained();
  const RgbdFrame view = exposed(office()[1], 0.4F);
  const auto expected = one.relocalise(view.view());
  REQUIRE(test::bit_equal(one.relocalise(view.view()), expected));
  for (const int num_threads : {2, 4}) {
    ForestRelocaliser several = test::untrained(num_threads);
    std::istringstream scene(test::saved(test::trained()));
    several.load(scene);
    REQUIRE(test::bit_equal(several.relocalise(view.view()), expected));
  }
}

}  // namespace
}  // namespace foothold

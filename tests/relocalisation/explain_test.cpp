// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include <Eigen/LU>

#include "foothold/relocalisation/forest_relocaliser.h"
#include "relocalisation/inliers.h"
#include "relocalisation/scenes.h"
#include "support/catch.h"

namespace foothold {
namespace {

using test::office;

/// Leaves of the small forest are 16 times fewer than the shipped one's, so that they need more points each for as many modes.
ForestRelocaliserSettings roomy_leaves() {
  ForestRelocaliserSettings settings = test::small_settings();
  settings.reservoirs.capacity = 256;
  settings.reservoirs.examples_per_view = 0;
  return settings;
}

TEST_CASE("ForestRelocaliser::explain: tells the candidates of relocalise(), and modes that account for them") {
  ForestRelocaliser relocaliser(test::context_of(1), test::small_forest(), roomy_leaves());
  test::train_on(relocaliser, office().size());
  const Frame frame = office()[1].view();
  const std::vector<PoseEstimate> estimates = relocaliser.relocalise(frame);
  const Explanation explanation = relocaliser.explain(frame);
  REQUIRE(!estimates.empty());
  REQUIRE(explanation.candidates.size() == estimates.size());
  for (std::size_t i = 0; i < estimates.size(); ++i) {
    REQUIRE(explanation.candidates[i].world_from_camera.translation == estimates[i].world_from_camera.translation);
    REQUIRE(explanation.candidates[i].confidence == estimates[i].confidence);
    REQUIRE(explanation.candidates[i].mean_energy >= 0.0F);
  }
  REQUIRE(explanation.pixels.size() > 100);
  for (const ExplainedPixel& pixel : explanation.pixels) {
    REQUIRE(pixel.num_modes > 0);
    REQUIRE(pixel.first_mode + pixel.num_modes <= explanation.modes.size());
    const Eigen::Vector2f seen = frame.calibration.depth.project(pixel.point_camera);
    REQUIRE(seen.minCoeff() > -1.0F);
    REQUIRE(seen.x() < static_cast<float>(frame.depth.width));
  }
  for (const ExplainedMode& mode : explanation.modes) {
    REQUIRE(mode.num_points > 0);
    REQUIRE(mode.covariance_world.determinant() > 0.0F);
  }
  REQUIRE(explanation.candidates[0].inlier_fraction > 0.1F);
  test::require_accounted_for(explanation, relocaliser.settings());
}

TEST_CASE("ForestRelocaliser::explain: has nothing to tell before training") {
  ForestRelocaliser relocaliser = test::untrained();
  REQUIRE(relocaliser.explain(office()[0].view()).candidates.empty());
}

}  // namespace
}  // namespace foothold

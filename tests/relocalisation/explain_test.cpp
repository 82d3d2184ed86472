// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include <Eigen/LU>
#include <algorithm>

#include "foothold/relocalisation/forest_relocaliser.h"
#include "relocalisation/scenes.h"
#include "support/catch.h"

namespace foothold {
namespace {

using test::office;

/// An inlier's distance to its mode; modes that are exactly so far may be counted either way.
constexpr float kInlierDistance = 0.05F;

/// The share of pixels with a mode within kInlierDistance of where the pose puts them.
double inlier_share(const Explanation& explanation, const SE3& world_from_camera) {
  int num_inliers = 0;
  for (const ExplainedPixel& pixel : explanation.pixels) {
    const Eigen::Vector3f point = world_from_camera * pixel.point_camera;
    const auto first = explanation.modes.begin() + static_cast<std::ptrdiff_t>(pixel.first_mode);
    const auto is_near = [&](const ExplainedMode& mode) { return (mode.mean_world - point).norm() < kInlierDistance; };
    num_inliers += std::any_of(first, first + static_cast<std::ptrdiff_t>(pixel.num_modes), is_near) ? 1 : 0;
  }
  return static_cast<double>(num_inliers) / static_cast<double>(explanation.pixels.size());
}

TEST_CASE("ForestRelocaliser::explain: tells the candidates of relocalise(), and modes that account for them") {
  ForestRelocaliser relocaliser = test::trained();
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
  // Of all pixels with depth, those without any mode included, so what is told can only be less.
  const double told = static_cast<double>(explanation.candidates[0].inlier_fraction);
  const double counted = inlier_share(explanation, explanation.candidates[0].world_from_camera);
  INFO(told << " told, " << counted << " counted");
  REQUIRE(told > 0.03);  // a frame fills few of the 40,000 leaves with enough points for a mode
  REQUIRE(counted >= told - 1e-3);
}

TEST_CASE("ForestRelocaliser::explain: has nothing to tell before training") {
  ForestRelocaliser relocaliser = test::untrained();
  REQUIRE(relocaliser.explain(office()[0].view()).candidates.empty());
}

}  // namespace
}  // namespace foothold

// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "pose/explain.h"

#include <Eigen/LU>

#include "foothold/base/contract.h"
#include "pose/confidence.h"

namespace foothold {
namespace {

ExplainedMode explain_mode(const Mode& mode, const Eigen::Vector3f& origin_world) {
  const float* p = mode.precision;
  Eigen::Matrix3f precision;
  precision << p[0], p[1], p[2], p[1], p[3], p[4], p[2], p[4], p[5];
  ExplainedMode explained;
  explained.mean_world = Eigen::Vector3f(mode.mean_m[0], mode.mean_m[1], mode.mean_m[2]) + origin_world;
  explained.covariance_world = precision.inverse();
  explained.colour = {mode.rgb[0], mode.rgb[1], mode.rgb[2]};
  explained.num_points = static_cast<int>(mode.num_points);
  return explained;
}

}  // namespace

Explanation explain(const PoseEstimator& estimator, const std::vector<PoseEstimate>& estimates, const Eigen::Vector3f& origin_world) {
  const PoseBuffers& buffers = estimator.buffers();
  Explanation explanation;
  const std::vector<PoseCandidate> candidates = buffers.candidates.to_host();
  for (const PoseCandidate& candidate : candidates) {
    if (candidate.valid == 0) continue;
    FOOTHOLD_EXPECTS(explanation.candidates.size() < estimates.size());
    const PoseEstimate& estimate = estimates[explanation.candidates.size()];
    explanation.candidates.push_back({estimate.world_from_camera, estimate.confidence, candidate.mean_energy, candidate.inlier_fraction});
  }
  const std::array<float, kNumConfidenceFeatures> features = confidence_features(candidates.front());
  for (std::size_t i = 0; i < features.size() && candidates.front().agreement.valid != 0; ++i) {
    explanation.evidence.push_back({kConfidenceFeatures[i].name, features[i]});
  }
  const std::vector<PooledPixel> pixels = buffers.pool.pixels.to_host();
  const std::size_t num_pixels = buffers.pool.slots.to_host()[buffers.pool.num_filled];
  const std::vector<Mode> modes = buffers.pool.modes.to_host();
  for (std::size_t i = 0; i < num_pixels; ++i) {
    const PooledPixel& pixel = pixels[i];
    explanation.pixels.push_back({{pixel.point_camera[0], pixel.point_camera[1], pixel.point_camera[2]},
                                  {pixel.rgb[0], pixel.rgb[1], pixel.rgb[2]},
                                  explanation.modes.size(),
                                  pixel.num_modes});
    for (std::size_t m = 0; m < pixel.num_modes; ++m) explanation.modes.push_back(explain_mode(modes[pixel.first_mode + m], origin_world));
  }
  return explanation;
}

}  // namespace foothold

// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// How far a candidate can be believed.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>

#include "pose/candidates.h"

namespace foothold {

inline constexpr std::size_t kNumConfidenceFeatures = 8;

/// What the confidence in an aligned candidate is made from, and how much each counts.
struct ConfidenceFeature {
  const char* name;
  float weight;
};
inline constexpr std::array<ConfidenceFeature, kNumConfidenceFeatures> kConfidenceFeatures{{{"log_inliers", 0.0F},
                                                                                            {"log_fine_inliers", 3.0F},
                                                                                            {"surface_fit", 0.0F},
                                                                                            {"agreeing", 0.0F},
                                                                                            {"contradicted", -19.4F},
                                                                                            {"colour_correlation", 2.4F},
                                                                                            {"contradicted_tiles", 0.0F},
                                                                                            {"explained_tiles", 0.0F}}};
inline constexpr float kConfidenceIntercept = 13.2F;

inline std::array<float, kNumConfidenceFeatures> confidence_features(const PoseCandidate& candidate) {
  const SceneAgreement& scene = candidate.agreement;
  return {std::log(candidate.inlier_fraction + 0.01F),
          std::log(candidate.fine_fraction + 0.005F),
          candidate.surface_fit,
          scene.agreeing_fraction,
          scene.contradicted_fraction,
          scene.colour_correlation,
          scene.contradicted_tiles,
          scene.explained_tiles};
}

/// The probability that a candidate is within 10 cm and 10 deg of the truth, by logistic regression (T: docs/trust.md).
inline float confidence_of(const PoseCandidate& candidate) {
  float log_odds = 0.0F;
  if (candidate.agreement.valid == 0) {  // not aligned: only the modes speak
    log_odds = 9.2F + 3.4F * std::log(candidate.inlier_fraction + 0.01F);
  } else {
    const std::array<float, kNumConfidenceFeatures> features = confidence_features(candidate);
    log_odds = kConfidenceIntercept;
    for (std::size_t i = 0; i < features.size(); ++i) log_odds += kConfidenceFeatures[i].weight * features[i];
  }
  return 1.0F / (1.0F + std::exp(-log_odds));
}

}  // namespace foothold

// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// How far a candidate can be believed.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>

#include "pose/candidates.h"

namespace foothold {

inline constexpr std::size_t kNumConfidenceFeatures = 6;

/// What the confidence in an aligned candidate is made from, and how much each counts.
struct ConfidenceFeature {
  const char* name;
  float weight;
};
/// (T) Fitted by scripts/fit_confidence.py to rendered rooms alone, training-20 to training-35 (data/forest_confidence.csv):
/// docs/experiments/trust.md.
inline constexpr std::array<ConfidenceFeature, kNumConfidenceFeatures> kConfidenceFeatures{{{"log_fine_inliers", 2.666F},
                                                                                            {"agreeing", 6.380F},
                                                                                            {"contradicted", -8.076F},
                                                                                            {"colour_correlation", 11.182F},
                                                                                            {"shifted", -2.795F},
                                                                                            {"rival", -3.253F}}};
inline constexpr float kConfidenceIntercept = -1.151F;

inline std::array<float, kNumConfidenceFeatures> confidence_features(const PoseCandidate& candidate) {
  const SceneAgreement& scene = candidate.agreement;
  return {std::log(candidate.fine_fraction + 0.005F),
          scene.agreeing_fraction,
          scene.contradicted_fraction,
          scene.colour_correlation,
          scene.shifted_agreement,
          scene.rival_agreement};
}

/// The probability that a candidate is within 10 cm and 10 deg of the truth, by logistic regression.
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

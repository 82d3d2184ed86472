// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// How far a candidate can be believed.
#pragma once

#include <cmath>

#include "pose/candidates.h"

namespace foothold {

/// The probability that a candidate is within 10 cm and 10 deg of the truth, by logistic regression.
/// (T) Fitted to relocalisations of two real recordings and of rendered rooms, queries from other scenes among them; the last line's
/// intercept was then lowered by 1.2, since wrong answers cost more than missing ones.
inline float confidence_of(const PoseCandidate& candidate) {
  const float log_inliers = std::log(candidate.inlier_fraction + 0.01F);
  const float log_fine = std::log(candidate.fine_fraction + 0.005F);
  const bool judged = candidate.contradicted_fraction + candidate.alike_fraction > 0.0F;
  float log_odds = 0.0F;
  if (candidate.surface_fit <= 0.0F) {  // not aligned: only the modes speak
    log_odds = 9.2F + 3.4F * log_inliers;
  } else if (!judged) {
    log_odds = 7.7F - 5.3F * log_inliers + 6.8F * log_fine + 19.7F * candidate.surface_fit;
  } else {
    log_odds = 13.2F + 3.0F * log_fine - 19.4F * candidate.contradicted_fraction + 2.4F * candidate.alike_fraction;
  }
  return 1.0F / (1.0F + std::exp(-log_odds));
}

}  // namespace foothold

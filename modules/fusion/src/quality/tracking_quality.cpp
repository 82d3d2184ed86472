// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "foothold/fusion/tracking_quality.h"

#include <limits>

namespace foothold {

const char* to_string(TrackingQuality quality) {
  switch (quality) {
    case TrackingQuality::kFailed:
      return "failed";
    case TrackingQuality::kPoor:
      return "poor";
    case TrackingQuality::kGood:
      return "good";
  }
  return "?";
}

std::array<float, 4> quality_features(const TrackingMeasures& measures) {
  return {measures.log_det_total, measures.log_det_valid, measures.residual_m, measures.inlier_fraction};
}

std::array<const char*, 4> quality_feature_names() { return {"log_det_total", "log_det_valid", "residual", "inlier_fraction"}; }

TrackingGrade grade_tracking(const TrackingMeasures& measures, const ClassifierModel& classifier) {
  if (!measures.well_posed) return {TrackingQuality::kFailed, -std::numeric_limits<float>::infinity(), 0.0F};
  TrackingGrade grade;
  const std::array<float, 4> features = quality_features(measures);
  grade.score = classifier.score(Span<const float>(features.data(), features.size()));
  grade.probability = classifier.probability(grade.score);
  grade.quality = grade.score > classifier.good_threshold   ? TrackingQuality::kGood
                  : grade.score > classifier.poor_threshold ? TrackingQuality::kPoor
                                                            : TrackingQuality::kFailed;
  return grade;
}

}  // namespace foothold

// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// Whether the tracker can be believed.
#pragma once

#include <array>

#include "foothold/fusion/classifier.h"
#include "foothold/fusion/icp_tracker.h"

namespace foothold {

/// What a tracked pose is good for.
enum class TrackingQuality {
  kFailed,  ///< wrong
  kPoor,    ///< perhaps right: neither to be fused nor trained on
  kGood     ///< right
};

/// The name of a quality, for people.
const char* to_string(TrackingQuality quality);

/// What the gate looks at: log_det_total, log_det_valid, residual [m], inlier fraction.
std::array<float, 4> quality_features(const TrackingMeasures& measures);
/// The names of quality_features(), in order.
std::array<const char*, 4> quality_feature_names();

/// A quality and what it rests on.
struct TrackingGrade {
  TrackingQuality quality = TrackingQuality::kFailed;  ///< good, poor or failed
  float score = 0.0F;                                  ///< of the classifier; higher is better
  float probability = 0.0F;                            ///< calibrated, of the pose being right
};

/// Grades tracking by a support vector machine over the tracker's own measures; an ill-posed alignment has failed outright.
/// Reference: [Prisacariu2017] Sec. 4.
TrackingGrade grade_tracking(const TrackingMeasures& measures, const ClassifierModel& classifier = default_tracking_classifier());

}  // namespace foothold

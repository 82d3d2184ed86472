// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// What a method's confidence is worth: recall against false accepts, and whether its probabilities come true.
#pragma once

#include <optional>
#include <vector>

#include "foothold/base/span.h"
#include "foothold/evaluation/protocol.h"
#include "foothold/evaluation/statistics.h"

namespace foothold {

/// One attempt to find the camera, as far as confidence is concerned.
struct ConfidenceSample {
  /// Of the best pose; empty without an answer.
  std::optional<double> confidence;
  /// The place had been learnt. Views of another scene cannot be found, and every answer to them is wrong.
  bool findable = true;
  bool found = false;  ///< within kFoundThreshold
  bool right = false;  ///< within kWrongThreshold
};

/// The sample that a test stands for. @param findable  False for a view of a scene that was not learnt.
ConfidenceSample confidence_sample(const TestRecord& test, bool findable);

/// What accepting every answer from some confidence on leads to.
struct AcceptancePoint {
  double threshold = 0.0;          ///< the confidence from which answers are accepted
  int num_accepted = 0;            ///< answers at or above the threshold
  int num_false_accepts = 0;       ///< accepted, but not right
  double recall = 0.0;             ///< accepted and found, of the findable samples
  double false_accept_rate = 0.0;  ///< accepted but not right, of all samples
};

/// Answers of about equal confidence.
struct CalibrationBin {
  double low = 0.0;              ///< confidences in [low, high); the last bin holds 1 too
  double high = 0.0;             ///< the upper end of the interval
  int num_answers = 0;           ///< with a confidence in the interval
  int num_right = 0;             ///< of these, within kWrongThreshold
  double mean_confidence = 0.0;  ///< NaN without answers
  Interval right_95;             ///< Wilson interval of num_right / num_answers
};

/// What the confidences of a set of samples are worth.
struct ConfidenceReport {
  int num_samples = 0;   ///< questions, answered or not
  int num_findable = 0;  ///< questions whose place had been learnt
  int num_answers = 0;   ///< questions that were answered
  /// From the strictest threshold, which accepts nothing, to the laxest; one point for each confidence that occurs.
  std::vector<AcceptancePoint> curve;
  std::vector<CalibrationBin> calibration;  ///< ten bins of equal width
  double roc_area = 0.0;                    ///< of right answers above wrong ones; NaN unless there are both
  /// Mean difference of confidence and share of right answers over the bins, weighted by their answers. Reference: [Naeini2015].
  double calibration_error = 0.0;
  double brier_score = 0.0;       ///< mean squared difference of confidence and outcome. Reference: [Brier1950]
  AcceptancePoint at_threshold;   ///< at the threshold that the method asks for
  AcceptancePoint without_false;  ///< the highest recall that accepts nothing wrong
};

/// Fractions without a denominator are 0, means without a term NaN.
/// @pre Confidences are in [0, 1].
ConfidenceReport make_confidence_report(Span<const ConfidenceSample> samples, double acceptance_threshold);

}  // namespace foothold

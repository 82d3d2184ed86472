// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// Trains the classifiers that grade tracking and accept relocalised poses, and says how good they are.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "foothold/base/settings.h"
#include "foothold/base/span.h"
#include "foothold/fusion/classifier.h"

namespace foothold {

/// One event and what it was.
struct ClassifierExample {
  std::vector<float> values;  ///< one for each feature, in the order of their names
  bool positive = false;      ///< what the classifier is to say
  float distance_m = 0.0F;    ///< from the truth, where it is known: for those who look at the examples
  float angle_deg = 0.0F;     ///< likewise [deg]
  int group = 0;              ///< the recording it comes from: examples of one are correlated, so cross-validation keeps them together
};

/// How a classifier is trained.
struct ClassifierTrainingSettings {
  /// Penalty of the support vector machine.
  float penalty = 1.0F;
  /// The good threshold lets at most this part of the negatives through, cross-validated.
  float max_false_positives = 0.001F;
  /// The poor threshold rejects at most this part of the positives, cross-validated.
  float max_false_negatives = 0.002F;
  /// More examples are thinned out evenly.
  int max_examples = 20000;

  /// Shows each field to the visitor, with its name, what it means and its range.
  template <class Visitor>
  static void fields(Visitor& v) {
    using S = ClassifierTrainingSettings;
    v(&S::penalty, "penalty", "Penalty of the support vector machine (T: train_quality_gate).", Range{1e-6, 1e6});
    v(&S::max_false_positives, "max_false_positives", "Part of the negatives above the good threshold.", Range{0.0, 1.0});
    v(&S::max_false_negatives, "max_false_negatives", "Part of the positives below the poor threshold.", Range{0.0, 1.0});
    v(&S::max_examples, "max_examples", "More examples are thinned out.", Range{10, 10000000});
  }
  /// Throws InvalidSettings naming the field, its value and its range.
  void validate() const { validate_settings(*this); }
};

/// A point of the receiver operating characteristic.
struct RocPoint {
  double threshold = 0.0;            ///< the score above which an event counts as positive
  double false_positive_rate = 0.0;  ///< of the negative events, in [0, 1]
  double true_positive_rate = 0.0;   ///< of the positive events, in [0, 1]
};

/// What cross-validation found: each group was scored by a classifier trained on the others.
struct ClassifierReport {
  int num_positive = 0;                   ///< events
  int num_negative = 0;                   ///< events
  double auc = 0.0;                       ///< the area under the curve below, in [0, 1]
  std::vector<RocPoint> roc;              ///< by falling threshold
  double true_positive_rate_good = 0.0;   ///< positives above the good threshold
  double false_positive_rate_good = 0.0;  ///< negatives above it
  double false_negative_rate_poor = 0.0;  ///< positives below the poor threshold
  double true_negative_rate_poor = 0.0;   ///< negatives below it
};

/// The receiver operating characteristic of scores, ties in one step, and the area under it.
std::vector<RocPoint> receiver_operating_characteristic(Span<const float> scores, Span<const std::uint8_t> positive, double* auc);

/// Trains a linear support vector machine over the chi-square map of normalised features, calibrates its probability, and sets both
/// thresholds.
///
/// @param names  One for each value of an example.
/// @throws InvalidSettings if there are fewer than two groups, or not both kinds of examples in training for every fold.
/// Reference: [Cortes1995], through OpenCV; probabilities [Platt1999].
ClassifierModel train_classifier(const std::string& name, const std::vector<std::string>& names,
                                 const std::vector<ClassifierExample>& examples, const ClassifierTrainingSettings& settings,
                                 ClassifierReport& report);

}  // namespace foothold

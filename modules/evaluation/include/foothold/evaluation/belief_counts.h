// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// How questions ended, as far as believing the answers goes.
#pragma once

#include "foothold/evaluation/confidence_report.h"

namespace foothold {

/// Questions by how they ended. An answer is right within kWrongThreshold, and believed from the method's own threshold on.
struct BeliefCounts {
  int num_questions = 0;         ///< all that were asked
  int num_right_believed = 0;    ///< answered rightly, and believed
  int num_right_unbelieved = 0;  ///< answered rightly, and not believed
  int num_wrong_believed = 0;    ///< answered wrongly, and believed
  int num_wrong_unbelieved = 0;  ///< the rest was not answered

  /// Adds a question, by its answer's error and confidence.
  void count(const ConfidenceSample& sample, double acceptance_threshold);
  /// Adds the questions of another set.
  BeliefCounts& operator+=(const BeliefCounts& other);

  /// Questions that were answered rightly, believed or not.
  int num_right() const { return num_right_believed + num_right_unbelieved; }
  /// Questions without an answer.
  int num_unanswered() const { return num_questions - num_right() - num_wrong_believed - num_wrong_unbelieved; }
  /// Wilson interval of the share of all questions that ended so.
  Interval right_believed_95() const { return wilson_interval(num_right_believed, num_questions); }
  /// Wilson interval of the share of all questions that ended with a wrong answer believed.
  Interval wrong_believed_95() const { return wilson_interval(num_wrong_believed, num_questions); }
  /// Wilson interval of the share of right answers that are believed.
  Interval believed_of_right_95() const { return wilson_interval(num_right_believed, num_right()); }
};

}  // namespace foothold

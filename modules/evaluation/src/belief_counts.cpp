// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "foothold/evaluation/belief_counts.h"

namespace foothold {

void BeliefCounts::count(const ConfidenceSample& sample, double acceptance_threshold) {
  ++num_questions;
  if (!sample.confidence.has_value()) return;
  const bool believed = *sample.confidence >= acceptance_threshold;
  if (sample.right) {
    ++(believed ? num_right_believed : num_right_unbelieved);
  } else {
    ++(believed ? num_wrong_believed : num_wrong_unbelieved);
  }
}

BeliefCounts& BeliefCounts::operator+=(const BeliefCounts& other) {
  num_questions += other.num_questions;
  num_right_believed += other.num_right_believed;
  num_right_unbelieved += other.num_right_unbelieved;
  num_wrong_believed += other.num_wrong_believed;
  num_wrong_unbelieved += other.num_wrong_unbelieved;
  return *this;
}

}  // namespace foothold

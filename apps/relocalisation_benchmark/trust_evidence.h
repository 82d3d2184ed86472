// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// What the forest's confidence is made from, question by question, to fit it to (scripts/fit_confidence.py).
#pragma once

#include <string>
#include <vector>

#include "trust_questions.h"

namespace foothold {
class ForestRelocaliser;
}

namespace foothold::benchmark {

/// Rows of a table, the header first: map, kind of question, whether the best answer was right (1) or wrong (0), its confidence, its error,
/// and the evidence by name.
class EvidenceTable {
 public:
  /// Learns a subject, asks all questions, and adds a row for each that has an answer.
  void add(ForestRelocaliser& relocaliser, const TrustSubject& subject, const std::vector<QuestionSet>& sets, int num_settling_updates);
  const std::string& csv() const { return csv_; }

 private:
  std::string csv_;
};

}  // namespace foothold::benchmark

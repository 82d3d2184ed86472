// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "foothold/evaluation/belief_counts.h"

#include "support/catch.h"

namespace foothold {
namespace {

TEST_CASE("BeliefCounts: every question ends in one of five ways") {
  BeliefCounts counts;
  for (const bool right : {true, false}) {
    counts.count({0.9, true, right, right}, 0.9);  // at the threshold: believed
    counts.count({0.8, true, right, right}, 0.9);
  }
  counts.count({std::nullopt, true, false, false}, 0.9);
  REQUIRE(counts.num_questions == 5);
  REQUIRE(counts.num_right_believed == 1);
  REQUIRE(counts.num_right_unbelieved == 1);
  REQUIRE(counts.num_wrong_believed == 1);
  REQUIRE(counts.num_wrong_unbelieved == 1);
  REQUIRE(counts.num_unanswered() == 1);
  counts += counts;
  REQUIRE(counts.num_questions == 10);
  REQUIRE(counts.num_right() == 4);
  REQUIRE(counts.num_unanswered() == 2);
}

TEST_CASE("BeliefCounts: intervals are of all questions, and of right answers") {
  BeliefCounts counts;
  for (int i = 0; i < 10; ++i) counts.count({i < 4 ? 0.95 : 0.1, true, i < 8, i < 8}, 0.9);
  REQUIRE(counts.right_believed_95().low == Approx(wilson_interval(4, 10).low));
  REQUIRE(counts.believed_of_right_95().high == Approx(wilson_interval(4, 8).high));
  REQUIRE(counts.wrong_believed_95().low == Approx(0.0).margin(1e-12));
  REQUIRE(BeliefCounts{}.wrong_believed_95().high == 1.0);
}

}  // namespace
}  // namespace foothold

// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "foothold/evaluation/method_report.h"

#include <cmath>

#include "fakes.h"
#include "foothold/evaluation/tracking_loss.h"
#include "support/catch.h"

namespace foothold {
namespace {

/// Offsets of single-precision positions.
constexpr double kReportTolerance = 1e-6;

/// Frames 1..400 answered in turn: frame i gets answer i modulo 8.
RunLog run_with_known_answers() {
  test::Oracle oracle;
  oracle.answers = {
      {0.005F, 0.9F},  // 1 cm rung, accepted
      {0.5F, 0.7F},    // wrong and accepted: a false accept
      {0.015F, 0.2F},  // 2 cm rung, not accepted
      {0.04F, 0.6F},   // 5 cm rung, accepted at the threshold exactly
      {0.0F, -1.0F},   // lost
      {0.08F, 0.8F},   // 10 cm rung, accepted: neither found nor false
      {1.0F, 0.1F},    // wrong and not accepted
      {0.0F, -1.0F},   // lost
  };
  return run_tracking_loss(oracle, test::make_input(0, 401), 0);
}

TEST_CASE("make_report: recall counts the best answer whatever its confidence") {
  const MethodReport report = make_report(run_with_known_answers());
  REQUIRE(report.num_tested == 400);
  REQUIRE(report.num_trained == 401);
  REQUIRE(report.num_answered == 300);
  const double expected[] = {1.0 / 8, 2.0 / 8, 3.0 / 8, 4.0 / 8};
  REQUIRE(report.recall.size() == 4);
  for (std::size_t i = 0; i < 4; ++i) REQUIRE(report.recall[i].fraction == Approx(expected[i]));
  REQUIRE(report.recall[2].num_found == 150);
  REQUIRE(report.recall_95.low < 0.375);
  REQUIRE(report.recall_95.high > 0.375);
}

TEST_CASE("make_report: accepted recall, false accepts and the false-confidence rate go by the threshold") {
  const MethodReport report = make_report(run_with_known_answers());
  REQUIRE(report.acceptance_threshold == 0.6F);
  REQUIRE(report.num_accepted == 200);
  REQUIRE(report.accepted_recall == Approx(100.0 / 400));
  REQUIRE(report.num_false_accepts == 50);
  REQUIRE(report.false_confidence_rate == Approx(50.0 / 200));
  // Right answers score .9, .2, .6, .8 and wrong ones .7, .1: six of the eight pairs are in order.
  REQUIRE(report.confidence_roc_area == Approx(6.0 / 8));
}

TEST_CASE("make_report: medians are over the answered frames, the first success is the first found frame") {
  const MethodReport report = make_report(run_with_known_answers());
  REQUIRE(report.first_success_frame == 2);
  REQUIRE(report.median_translation_m == Approx(0.06).margin(kReportTolerance));  // between .04 and .08
  REQUIRE(report.median_rotation_deg == Approx(0.0).margin(kReportTolerance));
  REQUIRE(report.state_mb == Approx(1.5));
}

TEST_CASE("make_report: windows of 100 tests partition the run") {
  test::Oracle oracle;
  oracle.answers = {{0.0F, 1.0F}, {1.0F, 1.0F}};
  const MethodReport report = make_report(run_tracking_loss(oracle, test::make_input(0, 251), 0));
  REQUIRE(report.recall_per_100.size() == 3);
  REQUIRE(report.recall_per_100[1].first_frame == 101);
  REQUIRE(report.recall_per_100[1].num_tested == 100);
  REQUIRE(report.recall_per_100[2].num_tested == 50);
  for (const RecallWindow& window : report.recall_per_100) REQUIRE(window.fraction == Approx(0.5));
}

TEST_CASE("make_report: a method that never answers has no medians, no first success and no false accepts") {
  test::Oracle oracle;
  oracle.answers = {{0.0F, -1.0F}};
  const MethodReport report = make_report(run_tracking_loss(oracle, test::make_input(0, 5), 0));
  REQUIRE(report.num_tested == 4);
  REQUIRE(report.recall[3].fraction == 0.0);
  REQUIRE_FALSE(report.first_success_frame.has_value());
  REQUIRE(std::isnan(report.median_translation_m));
  REQUIRE(std::isnan(report.confidence_roc_area));
  REQUIRE(report.false_confidence_rate == 0.0);
  REQUIRE(report.train.num_calls == 5);
}

TEST_CASE("make_report: an empty log is an empty report") {
  const MethodReport report = make_report(RunLog{});
  REQUIRE(report.num_tested == 0);
  REQUIRE(report.recall_per_100.empty());
  REQUIRE(std::isnan(report.train.wall_ms.median));
}

}  // namespace
}  // namespace foothold

// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "foothold/evaluation/confidence_report.h"

#include <cmath>
#include <limits>

#include "foothold/base/error.h"
#include "support/catch.h"
#include "support/random_seed.h"

namespace foothold {
namespace {

/// Double precision over a few hundred terms.
constexpr double kRateTolerance = 1e-12;

std::vector<ConfidenceSample> random_samples(Random& random, int count) {
  std::vector<ConfidenceSample> samples;
  for (int i = 0; i < count; ++i) {
    ConfidenceSample sample;
    if (random.below(8) != 0) sample.confidence = random.below(21) / 20.0;  // ties, 0 and 1 included
    sample.findable = random.below(4) != 0;
    sample.right = sample.findable && sample.confidence.has_value() && random.uniform() < *sample.confidence;
    sample.found = sample.right && random.below(3) != 0;
    samples.push_back(sample);
  }
  return samples;
}

/// The definition, sample by sample.
AcceptancePoint naive_point(const std::vector<ConfidenceSample>& samples, double threshold) {
  AcceptancePoint point;
  int num_found = 0;
  int num_findable = 0;
  for (const ConfidenceSample& sample : samples) {
    const bool accepted = sample.confidence.has_value() && *sample.confidence >= threshold;
    point.num_accepted += accepted ? 1 : 0;
    point.num_false_accepts += accepted && !sample.right ? 1 : 0;
    num_found += accepted && sample.found ? 1 : 0;
    num_findable += sample.findable ? 1 : 0;
  }
  point.recall = static_cast<double>(num_found) / num_findable;
  point.false_accept_rate = static_cast<double>(point.num_false_accepts) / static_cast<double>(samples.size());
  return point;
}

void require_equal(const AcceptancePoint& a, const AcceptancePoint& b) {
  REQUIRE(a.num_accepted == b.num_accepted);
  REQUIRE(a.num_false_accepts == b.num_false_accepts);
  REQUIRE(std::abs(a.recall - b.recall) < kRateTolerance);
  REQUIRE(std::abs(a.false_accept_rate - b.false_accept_rate) < kRateTolerance);
}

TEST_CASE("make_confidence_report: each point of the curve counts what its threshold accepts") {
  Random random = test::test_random();
  for (int trial = 0; trial < 20; ++trial) {
    const std::vector<ConfidenceSample> samples = random_samples(random, 120);
    const double threshold = random.below(21) / 20.0 + (trial % 2 == 0 ? 0.01 : 0.0);
    const ConfidenceReport report = make_confidence_report(samples, threshold);
    REQUIRE(report.curve.front().num_accepted == 0);
    REQUIRE(report.curve.back().num_accepted == report.num_answers);
    for (std::size_t i = 0; i < report.curve.size(); ++i) {
      require_equal(report.curve[i], naive_point(samples, report.curve[i].threshold));
      if (i > 0) REQUIRE(report.curve[i].threshold < report.curve[i - 1].threshold);
    }
    require_equal(report.at_threshold, naive_point(samples, threshold));
    REQUIRE(report.at_threshold.threshold == threshold);
    REQUIRE(report.without_false.num_false_accepts == 0);
  }
}

TEST_CASE("make_confidence_report: bins hold every answer once, and errors vanish for an oracle") {
  Random random = test::test_random();
  const std::vector<ConfidenceSample> samples = random_samples(random, 400);
  const ConfidenceReport report = make_confidence_report(samples, 0.5);
  int num_answers = 0;
  int num_right = 0;
  for (const CalibrationBin& bin : report.calibration) {
    num_answers += bin.num_answers;
    num_right += bin.num_right;
    if (bin.num_answers > 0) REQUIRE((bin.low - kRateTolerance <= bin.mean_confidence && bin.mean_confidence <= bin.high + kRateTolerance));
  }
  REQUIRE(num_answers == report.num_answers);
  REQUIRE(num_right == report.num_answers - report.curve.back().num_false_accepts);
  REQUIRE(report.calibration_error < 0.15);  // confidences are true probabilities; 15 or so samples a bin of three

  std::vector<ConfidenceSample> certain(10);
  for (std::size_t i = 0; i < certain.size(); ++i) {
    certain[i].right = i % 2 == 0;
    certain[i].confidence = certain[i].right ? 1.0 : 0.0;
  }
  const ConfidenceReport oracle = make_confidence_report(certain, 0.5);
  REQUIRE(oracle.brier_score == 0.0);
  REQUIRE(oracle.calibration_error == 0.0);
  REQUIRE(oracle.roc_area == 1.0);
  REQUIRE(oracle.without_false.num_accepted == 5);
}

TEST_CASE("make_confidence_report: without answers nothing is accepted and nothing is known") {
  const ConfidenceReport report = make_confidence_report(std::vector<ConfidenceSample>(3), 0.5);
  REQUIRE(report.num_answers == 0);
  REQUIRE(report.curve.size() == 1);
  REQUIRE(report.at_threshold.recall == 0.0);
  REQUIRE(std::isnan(report.roc_area));
  REQUIRE(std::isnan(report.brier_score));
  REQUIRE(std::isnan(report.calibration_error));
  REQUIRE(make_confidence_report(Span<const ConfidenceSample>(), 0.5).num_samples == 0);
}

TEST_CASE("make_confidence_report: refuses a confidence outside [0, 1]") {
  std::vector<ConfidenceSample> samples(1);
  samples[0].confidence = 1.5;
  REQUIRE_THROWS_AS(make_confidence_report(samples, 0.5), ContractViolation);
}

TEST_CASE("confidence_sample: no answer to an unknown place is right, however near its pose") {
  TestRecord test;
  test.best = PoseEstimate{SE3{}, 0.7F};
  test.error = {0.06, 0.01};
  const ConfidenceSample known = confidence_sample(test, true);
  REQUIRE(known.right);
  REQUIRE(!known.found);
  REQUIRE(*known.confidence == static_cast<double>(0.7F));
  REQUIRE(!confidence_sample(test, false).right);
  test.best.reset();
  test.error = {std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
  REQUIRE(!confidence_sample(test, true).confidence.has_value());
}

}  // namespace
}  // namespace foothold

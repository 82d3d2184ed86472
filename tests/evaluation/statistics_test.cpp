// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "foothold/evaluation/statistics.h"

#include <cmath>

#include "foothold/base/error.h"
#include "support/catch.h"
#include "support/random_seed.h"

namespace foothold {
namespace {

/// Double precision over a few hundred terms.
constexpr double kStatisticTolerance = 1e-12;

/// Counts pairs: the definition of the area under the ROC curve.
double roc_area_of_pairs(const std::vector<double>& scores, const std::vector<bool>& right) {
  double wins = 0.0;
  double num_pairs = 0.0;
  for (std::size_t i = 0; i < scores.size(); ++i) {
    for (std::size_t j = 0; j < scores.size(); ++j) {
      if (!right[i] || right[j]) continue;
      num_pairs += 1.0;
      wins += scores[i] > scores[j] ? 1.0 : scores[i] == scores[j] ? 0.5 : 0.0;
    }
  }
  return wins / num_pairs;
}

TEST_CASE("roc_area: equals the share of pairs in the right order, ties counting half") {
  Random random = test::test_random();
  for (int trial = 0; trial < 50; ++trial) {
    const std::uint32_t num_levels = 1 + random.below(20);  // few levels make many ties
    std::vector<double> scores = {0.0, 0.0};
    std::vector<bool> right = {true, false};
    for (int i = 0; i < 60; ++i) {
      scores.push_back(random.below(num_levels));
      right.push_back(random.below(2) == 1);
    }
    REQUIRE(std::abs(roc_area(scores, right) - roc_area_of_pairs(scores, right)) < kStatisticTolerance);
  }
}

TEST_CASE("roc_area: a constant score reads one half, a perfect one 1, an inverted one 0") {
  REQUIRE(roc_area({3, 3, 3, 3}, {true, false, true, true}) == 0.5);
  REQUIRE(roc_area({1, 2, 3, 4}, {false, false, true, true}) == 1.0);
  REQUIRE(roc_area({1, 2, 3, 4}, {true, true, false, false}) == 0.0);
}

TEST_CASE("roc_area: is undefined with one kind only") {
  REQUIRE(std::isnan(roc_area({}, {})));
  REQUIRE(std::isnan(roc_area({1, 2}, {true, true})));
  REQUIRE(std::isnan(roc_area({1, 2}, {false, false})));
}

TEST_CASE("roc_area: refuses lists of different length") { REQUIRE_THROWS_AS(roc_area({1, 2}, {true}), ContractViolation); }

TEST_CASE("wilson_interval: its ends solve the score equation |p - q| = z sqrt(q (1 - q) / n)") {
  const double z = 1.959963984540054;
  for (const auto& [successes, trials] : {std::pair{0, 10}, {3, 10}, {10, 10}, {1, 1}, {985, 999}}) {
    const Interval interval = wilson_interval(successes, trials);
    const double p = static_cast<double>(successes) / trials;
    REQUIRE(interval.low <= p);
    REQUIRE(interval.high >= p);
    if (successes > 0) REQUIRE(p - interval.low == Approx(z * std::sqrt(interval.low * (1.0 - interval.low) / trials)));
    if (successes < trials) REQUIRE(interval.high - p == Approx(z * std::sqrt(interval.high * (1.0 - interval.high) / trials)));
  }
}

TEST_CASE("wilson_interval: matches a published value, and says nothing without trials") {
  // 81 of 263: [0.2553, 0.3662] in [Newcombe1998], Table I, method 3.
  const Interval interval = wilson_interval(81, 263);
  REQUIRE(interval.low == Approx(0.2553).margin(5e-5));
  REQUIRE(interval.high == Approx(0.3662).margin(5e-5));
  REQUIRE(wilson_interval(0, 0).low == 0.0);
  REQUIRE(wilson_interval(0, 0).high == 1.0);
}

TEST_CASE("wilson_interval: refuses more successes than trials") { REQUIRE_THROWS_AS(wilson_interval(3, 2), ContractViolation); }

TEST_CASE("spread_of: median and 95th percentile") {
  std::vector<double> values;
  for (int i = 100; i >= 0; --i) values.push_back(i);
  REQUIRE(spread_of(values).median == 50.0);
  REQUIRE(spread_of(values).p95 == 95.0);
  REQUIRE(std::isnan(spread_of({}).median));
}

}  // namespace
}  // namespace foothold

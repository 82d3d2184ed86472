// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "foothold/evaluation/statistics.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "foothold/base/contract.h"
#include "foothold/base/trace.h"

namespace foothold {

Interval wilson_interval(int num_successes, int num_trials, double z) {
  FOOTHOLD_EXPECTS(num_successes >= 0 && num_successes <= num_trials);
  if (num_trials == 0) return {0.0, 1.0};
  const double n = num_trials;
  const double p = num_successes / n;
  const double z2 = z * z;
  const double centre = (p + z2 / (2.0 * n)) / (1.0 + z2 / n);
  const double half_width = z / (1.0 + z2 / n) * std::sqrt(p * (1.0 - p) / n + z2 / (4.0 * n * n));
  return {std::clamp(centre - half_width, 0.0, p), std::clamp(centre + half_width, p, 1.0)};  // rounding must not exclude p itself
}

double roc_area(const std::vector<double>& scores, const std::vector<bool>& right) {
  FOOTHOLD_EXPECTS(scores.size() == right.size());
  std::vector<std::size_t> order(scores.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return scores[a] < scores[b]; });
  double right_ranks = 0.0;
  double num_right = 0.0;
  for (std::size_t begin = 0; begin < order.size();) {
    std::size_t end = begin;
    while (end < order.size() && scores[order[end]] == scores[order[begin]]) ++end;
    const double mid_rank = 0.5 * static_cast<double>(begin + 1 + end);  // ranks begin + 1 .. end share their mean
    for (; begin < end; ++begin) {
      if (!right[order[begin]]) continue;
      right_ranks += mid_rank;
      num_right += 1.0;
    }
  }
  const double num_wrong = static_cast<double>(scores.size()) - num_right;
  if (num_right == 0.0 || num_wrong == 0.0) return std::numeric_limits<double>::quiet_NaN();
  return (right_ranks - 0.5 * num_right * (num_right + 1.0)) / (num_right * num_wrong);
}

Spread spread_of(const std::vector<double>& values) { return {quantile(values, 0.5), quantile(values, 0.95)}; }

}  // namespace foothold

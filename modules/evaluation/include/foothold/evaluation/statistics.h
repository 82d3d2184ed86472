// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// Statistics of small samples: medians, intervals of proportions, areas under ROC curves.
#pragma once

#include <vector>

namespace foothold {

/// An interval of values.
struct Interval {
  double low = 0.0;   ///< the lower end
  double high = 0.0;  ///< the upper end
};

/// The Wilson score interval of a proportion, sound for few trials and for proportions near 0 and 1; [0, 1] without trials.
/// @param z  Standard normal quantile; 1.96 for 95 %.
/// @pre 0 <= num_successes <= num_trials
/// Reference: [Wilson1927].
Interval wilson_interval(int num_successes, int num_trials, double z = 1.959963984540054);

/// The area under the ROC curve of a score that should be high for right items: the probability that a right item scores above a wrong one.
/// Ties count one half (mid-ranks), so a constant score reads 0.5.
/// @return NaN unless there are both right and wrong items.  @pre scores.size() == right.size(); no score is NaN.
/// Reference: [HanleyMcNeil1982].
double roc_area(const std::vector<double>& scores, const std::vector<bool>& right);

/// The median and the 95th percentile of a set of numbers; NaN for an empty set.
struct Spread {
  double median = 0.0;  ///< the value that half of the numbers do not exceed
  double p95 = 0.0;     ///< the value that 95 of 100 do not exceed
};

/// The median and 95th percentile of a list; NaN for an empty one.
Spread spread_of(const std::vector<double>& values);

}  // namespace foothold

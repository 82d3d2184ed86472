// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// What becomes of accuracy, time and memory as more is learnt: one point for each amount.
#pragma once

#include <string>
#include <vector>

#include "json_parts.h"

namespace foothold::benchmark {

/// How tests ended, as far as believing them goes; the four add up to the tests.
struct BeliefCounts {
  int num_right = 0;        ///< believed, within kWrongThreshold
  int num_unsure = 0;       ///< not answered, or not believed
  int num_wrong_here = 0;   ///< believed, wrong, but nearest to the place that was shown
  int num_wrong_place = 0;  ///< believed, and nearest to another place
};

struct GrowthPoint {
  int amount = 0;  ///< such as places learnt, or frames of standing still
  MethodResult result;
  BeliefCounts beliefs;
  Spread first_train_ms;  ///< of what was learnt first: the first place, or the first frames
  Spread last_train_ms;   ///< of what was learnt last
};

/// One method.
struct GrowthCurve {
  std::string method;
  std::vector<GrowthPoint> points;
};

/// A Markdown table for people, a row per method and amount.
std::string growth_table(const std::vector<GrowthCurve>& curves, const std::string& amount_name);
/// An object per method, each with `points`.
Json growth_json(const std::vector<GrowthCurve>& curves, const std::string& amount_key);
/// A line per method and amount.
std::string growth_csv(const std::vector<GrowthCurve>& curves, const std::string& amount_key);

}  // namespace foothold::benchmark

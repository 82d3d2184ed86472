// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// What becomes of accuracy, time and memory as more is learnt: one point for each amount.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "json_parts.h"
#include "places.h"

namespace foothold::benchmark {

/// How tests ended, as far as believing them goes; the four add up to the tests.
struct PlaceBeliefs {
  int num_right = 0;        ///< believed, within kWrongThreshold
  int num_unsure = 0;       ///< not answered, or not believed
  int num_wrong_here = 0;   ///< believed, wrong, but nearest to the place that was shown
  int num_wrong_place = 0;  ///< believed, and nearest to another place
};

struct GrowthPoint {
  int amount = 0;  ///< such as places learnt, or frames of standing still
  MethodResult result;
  PlaceBeliefs beliefs;
  Spread first_train_ms;  ///< of what was learnt first: the first place, or the first frames
  Spread last_train_ms;   ///< of what was learnt last
};

/// How the tests of a run ended. @param places  What was learnt; tests of input i show place i.
PlaceBeliefs count_beliefs(const RunLog& log, const std::vector<Place>& places);

/// The durations of learning frames [begin, end).
Spread train_spread(const RunLog& log, std::size_t begin, std::size_t end);

/// Puts the tests of runs together as one, test inputs and memory one after another.
MethodResult joined(const std::vector<MethodResult>& runs);

/// One method.
struct GrowthCurve {
  std::string method;
  std::optional<GrowthPoint> alone;  ///< every tested place learnt and tested by itself, its memory summed
  std::vector<GrowthPoint> points;
};

/// A Markdown table for people, a row per method and amount.
std::string growth_table(const std::vector<GrowthCurve>& curves, const std::string& amount_name);
/// How the tests ended, likewise.
std::string belief_table(const std::vector<GrowthCurve>& curves, const std::string& amount_name);
/// An object per method, each with `points`.
Json growth_json(const std::vector<GrowthCurve>& curves, const std::string& amount_key);
/// A line per method and amount.
std::string growth_csv(const std::vector<GrowthCurve>& curves, const std::string& amount_key);
/// Charts of recall and acceptance, time and memory over the amount, as a PNG file. @throws FileError
void write_growth_plot(const std::string& path, const std::vector<GrowthCurve>& curves, const std::string& amount_name);

}  // namespace foothold::benchmark

// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "time_unit.h"

#include <algorithm>
#include <cstddef>

namespace foothold::io {
namespace {

constexpr double kUnits_s[] = {1.0, 1e-3, 1e-6, 1e-9};

/// The median of what lies between consecutive times, where they rise; 0 if they never do.
double median_step(const std::vector<double>& times) {
  std::vector<double> steps;
  for (std::size_t i = 1; i < times.size(); ++i) {
    if (times[i] > times[i - 1]) steps.push_back(times[i] - times[i - 1]);
  }
  if (steps.empty()) return 0.0;
  const auto middle = steps.begin() + static_cast<std::ptrdiff_t>(steps.size() / 2);
  std::nth_element(steps.begin(), middle, steps.end());
  return *middle;
}

/// Which part of one stretch of time another covers; 1 for a moment inside.
double covered_part(double first, double last, double from, double to) {
  const double overlap = std::min(last, to) - std::max(first, from);
  if (overlap < 0.0) return 0.0;
  return last > first ? overlap / (last - first) : 1.0;
}

}  // namespace

double seconds_per_unit(const std::vector<double>& times) {
  constexpr double kLongest_s = 8.0;
  const double step = median_step(times);
  for (const double unit_s : kUnits_s) {
    if (step * unit_s < kLongest_s) return unit_s;
  }
  return 1.0;
}

double sample_unit(const std::vector<double>& times, double first_frame_s, double last_frame_s, double max_gap_s) {
  constexpr double kLeastPart = 0.05;  // of the frames' time; in a wrong unit, it is a thousandth or nothing
  const double step = median_step(times);
  double first_covering_s = 0.0;
  for (const double unit_s : kUnits_s) {
    if (covered_part(first_frame_s, last_frame_s, times.front() * unit_s, times.back() * unit_s) < kLeastPart) continue;
    if (step * unit_s <= max_gap_s) return unit_s;
    if (first_covering_s == 0.0) first_covering_s = unit_s;
  }
  return first_covering_s != 0.0 ? first_covering_s : 1.0;
}

const char* time_unit_name(double seconds_per_unit) {
  return seconds_per_unit == 1.0    ? "seconds"
         : seconds_per_unit == 1e-3 ? "milliseconds"
         : seconds_per_unit == 1e-6 ? "microseconds"
                                    : "nanoseconds";
}

}  // namespace foothold::io

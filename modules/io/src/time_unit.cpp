// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "time_unit.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace foothold::io {
namespace {

constexpr double kUnits_s[] = {1.0, 1e-3, 1e-6, 1e-9};

}  // namespace

double seconds_per_unit(std::vector<double> times) {
  constexpr double kLongest_s = 8.0;
  std::vector<double> steps;
  for (std::size_t i = 1; i < times.size(); ++i) {
    if (times[i] > times[i - 1]) steps.push_back(times[i] - times[i - 1]);
  }
  if (steps.empty()) return 1.0;
  const auto middle = steps.begin() + static_cast<std::ptrdiff_t>(steps.size() / 2);
  std::nth_element(steps.begin(), middle, steps.end());
  for (const double unit_s : kUnits_s) {
    if (*middle * unit_s < kLongest_s) return unit_s;
  }
  return 1.0;
}

double overlapping_unit(double first, double last, double first_frame_s, double last_frame_s) {
  for (const double unit_s : kUnits_s) {
    if (first * unit_s <= last_frame_s && last * unit_s >= first_frame_s) return unit_s;
  }
  return 1.0;
}

const char* time_unit_name(double seconds_per_unit) {
  return seconds_per_unit == 1.0    ? "seconds"
         : seconds_per_unit == 1e-3 ? "milliseconds"
         : seconds_per_unit == 1e-6 ? "microseconds"
                                    : "nanoseconds";
}

}  // namespace foothold::io

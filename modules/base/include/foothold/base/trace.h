// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// Where the time goes: named stages measured on the host, and summaries of them.
#pragma once

#include <chrono>
#include <map>
#include <string>
#include <vector>

namespace foothold {

/// Collects durations [ms] under stage names such as "train/cluster". One trace per thread of control; not thread-safe.
class Trace {
 public:
  /// Notes a duration of a stage.
  void add(const std::string& stage, double duration_ms) { stages_[stage].push_back(duration_ms); }
  /// All durations by stage, each in the order measured.
  const std::map<std::string, std::vector<double>>& stages() const { return stages_; }
  /// Forgets all durations.
  void clear() { stages_.clear(); }

 private:
  std::map<std::string, std::vector<double>> stages_;
};

/// The p-quantile of a set of numbers by linear interpolation, p in [0, 1]; NaN for an empty set.
double quantile(std::vector<double> values, double p);

/// A running clock.
class Stopwatch {
 public:
  /// Time since the clock was made [ms].
  double elapsed_ms() const { return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start_).count(); }

 private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

}  // namespace foothold

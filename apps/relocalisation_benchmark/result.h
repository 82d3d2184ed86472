// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// What a benchmark found, before it is written in one form or another.
#pragma once

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "foothold/evaluation/method_report.h"
#include "foothold/evaluation/novelty.h"

namespace foothold::benchmark {

struct MethodResult {
  std::string name;
  RunLog log;
  MethodReport report;
  std::vector<NoveltyBin> novelty;  ///< empty where the protocol has no separate training views
  double peak_mb = 0.0;             ///< most memory that the process held while the method ran [1e6 bytes]
  /// The settings that the method ran with: path without the method's name, value as text.
  std::vector<std::pair<std::string, std::string>> settings;
};

/// Durations by stage, over all kinds of call. Stages are named after the call that they belong to, such as "train/cluster"; updates repeat
/// stages of training, and those keep the name and the numbers of training.
std::map<std::string, Spread> stages_of(const MethodReport& report);

struct BenchmarkResult {
  std::string protocol;  ///< "loss" or "split"
  std::vector<std::string> training;
  std::vector<std::string> tested;
  /// The options that shaped the run: name and value as text.
  std::vector<std::pair<std::string, std::string>> options;
  std::vector<MethodResult> methods;
};

}  // namespace foothold::benchmark

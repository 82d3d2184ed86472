// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// What the JSON documents of all commands share; docs/benchmark-json.md describes them.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "common/json.h"
#include "foothold/evaluation/confidence_report.h"
#include "result.h"

namespace foothold::benchmark {

using apps::Json;

Json interval_json(const Interval& interval);
Json spread_json(const Spread& spread);
/// The bins of a reliability diagram.
Json calibration_json(const std::vector<CalibrationBin>& bins);
Json novelty_json(const std::vector<NoveltyBin>& bins);

/// Format, version, protocol, settings and machine: the beginning of every document.
Json document_head(const std::string& protocol, const std::vector<std::pair<std::string, std::string>>& options);

/// What equal options reproduce: counts, recall, errors, confidence, memory of the scene.
Json accuracy_json(const MethodReport& report);
/// What differs from run to run: durations and the memory of the process.
Json timing_json(const MethodResult& method);

}  // namespace foothold::benchmark

// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "json_parts.h"

#include <cmath>
#include <fstream>
#include <thread>

#include "common/log.h"

namespace foothold::benchmark {
namespace {

/// Raised when a key changes its meaning or goes away; new keys do not raise it.
constexpr int kFormatVersion = 1;

/// The processor's name as Linux tells it; empty elsewhere.
std::string processor_name() {
  std::ifstream info("/proc/cpuinfo");
  for (std::string line; std::getline(info, line);) {
    const std::size_t colon = line.find(": ");
    if (line.rfind("model name", 0) == 0 && colon != std::string::npos) return line.substr(colon + 2);
  }
  return {};
}

Json stages_json(const MethodReport& report) {
  Json stages = Json::object();
  for (const auto& [stage, ms] : stages_of(report)) stages[stage] = spread_json(ms);
  return stages;
}

Json recall_json(const MethodReport& report) {
  Json recall = Json::object();
  for (const Recall& rung : report.recall) recall[rung.threshold.key()] = rung.fraction;
  return recall;
}

Json windows_json(const MethodReport& report) {
  Json windows = Json::array();
  for (const RecallWindow& window : report.recall_per_100) {
    windows.push_back({{"first_frame", window.first_frame}, {"num_tested", window.num_tested}, {"5cm_5deg", window.fraction}});
  }
  return windows;
}

Json confidence_json(const MethodReport& report) {
  return {{"acceptance_threshold", report.acceptance_threshold},
          {"num_accepted", report.num_accepted},
          {"accepted_recall", report.accepted_recall},
          {"false_accepts", report.num_false_accepts},
          {"false_confidence_rate", report.false_confidence_rate},
          {"roc_area", report.confidence_roc_area}};
}

}  // namespace

Json spread_json(const Spread& spread) { return {{"median", spread.median}, {"p95", spread.p95}}; }

Json interval_json(const Interval& interval) { return Json::array({interval.low, interval.high}); }

Json calibration_json(const std::vector<CalibrationBin>& bins) {
  Json json = Json::array();
  for (const CalibrationBin& bin : bins) {
    json.push_back({{"low", bin.low},
                    {"high", bin.high},
                    {"num_answers", bin.num_answers},
                    {"num_right", bin.num_right},
                    {"mean_confidence", bin.mean_confidence},
                    {"right_95", interval_json(bin.right_95)}});
  }
  return json;
}

Json novelty_json(const std::vector<NoveltyBin>& bins) {
  Json result = Json::array();
  for (const NoveltyBin& bin : bins) {
    const double fraction = bin.num_frames == 0 ? std::nan("") : static_cast<double>(bin.num_found) / bin.num_frames;
    result.push_back({{"bin", bin.key()},
                      {"num_frames", bin.num_frames},
                      {"num_found", bin.num_found},
                      {"recall", fraction},
                      {"recall_95", interval_json(bin.recall_95)}});
  }
  return result;
}

Json document_head(const std::string& protocol, const std::vector<std::pair<std::string, std::string>>& options) {
  Json json;
  json["format"] = "foothold-benchmark";
  json["format_version"] = kFormatVersion;
  json["protocol"] = protocol;
  json["settings"] = Json::nested(options);
  json["warnings"] = apps::warnings();
  json["machine"] = {{"processor", processor_name()}, {"num_threads", std::thread::hardware_concurrency()}};
  return json;
}

Json accuracy_json(const MethodReport& report) {
  Json json;
  json["num_trained"] = report.num_trained;
  json["num_tested"] = report.num_tested;
  json["num_without_pose"] = report.num_without_pose;
  json["num_without_depth"] = report.num_without_depth;
  json["num_answered"] = report.num_answered;
  json["recall"] = recall_json(report);
  json["recall_5cm_5deg_95"] = interval_json(report.recall_95);
  json["first_success_frame"] = report.first_success_frame.has_value() ? Json(*report.first_success_frame) : Json(nullptr);
  json["recall_per_100_frames"] = windows_json(report);
  json["median_translation_error_m"] = report.median_translation_m;
  json["median_rotation_error_deg"] = report.median_rotation_deg;
  json["confidence"] = confidence_json(report);
  json["state_mb"] = report.state_mb;
  return json;
}

Json timing_json(const MethodResult& method) {
  const MethodReport& report = method.report;
  Json json;
  json["train_ms"] = spread_json(report.train.wall_ms);
  json["train_cpu_ms"] = spread_json(report.train.cpu_ms);
  json["relocalise_ms"] = spread_json(report.relocalise.wall_ms);
  json["relocalise_cpu_ms"] = spread_json(report.relocalise.cpu_ms);
  json["update_ms"] = spread_json(report.update.wall_ms);
  json["stages_ms"] = stages_json(report);
  json["peak_mb"] = method.peak_mb;
  return json;
}

}  // namespace foothold::benchmark

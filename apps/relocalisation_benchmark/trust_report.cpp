// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "trust_report.h"

#include <algorithm>

#include "foothold/evaluation/text_table.h"
#include "outputs.h"
#include "trust_questions.h"

namespace foothold::benchmark {
namespace {

constexpr double kDegPerRad = 57.29577951308232;
/// Points of a curve that are written at most.
constexpr std::size_t kMostCurvePoints = 256;

std::string percent(double fraction) { return format_number(100.0 * fraction, 1); }

/// "12.0 [10.1, 14.2]"
std::string share_text(int count, int whole, const Interval& interval) {
  if (whole == 0) return "-";
  return percent(static_cast<double>(count) / whole) + " [" + percent(interval.low) + ", " + percent(interval.high) + "]";
}

std::vector<std::string> counts_row(const std::string& method, const std::string& name, const BeliefCounts& counts) {
  return {method,
          name,
          std::to_string(counts.num_questions),
          share_text(counts.num_right_believed, counts.num_questions, counts.right_believed_95()),
          std::to_string(counts.num_right_unbelieved),
          std::to_string(counts.num_wrong_believed) + " [" + format_number(counts.num_questions * counts.wrong_believed_95().low, 1) +
              ", " + format_number(counts.num_questions * counts.wrong_believed_95().high, 1) + "]",
          std::to_string(counts.num_wrong_unbelieved + counts.num_unanswered())};
}

Json counts_json(const BeliefCounts& counts) {
  return {{"num_questions", counts.num_questions},
          {"right_believed", counts.num_right_believed},
          {"right_unbelieved", counts.num_right_unbelieved},
          {"wrong_believed", counts.num_wrong_believed},
          {"wrong_unbelieved", counts.num_wrong_unbelieved},
          {"unanswered", counts.num_unanswered()},
          {"right_believed_95", interval_json(counts.right_believed_95())},
          {"wrong_believed_95", interval_json(counts.wrong_believed_95())},
          {"believed_of_right_95", interval_json(counts.believed_of_right_95())}};
}

/// Evenly chosen points of risk against coverage, both ends included.
Json risk_coverage_json(const ConfidenceReport& report) {
  Json json = Json::array();
  const std::size_t count = std::min(report.curve.size(), kMostCurvePoints);
  for (std::size_t i = 0; i < count; ++i) {
    const AcceptancePoint& point = report.curve[count < 2 ? 0 : i * (report.curve.size() - 1) / (count - 1)];
    json.push_back({{"threshold", point.threshold},
                    {"coverage", static_cast<double>(point.num_accepted) / std::max(1, report.num_samples)},
                    {"risk", static_cast<double>(point.num_false_accepts) / std::max(1, point.num_accepted)}});
  }
  return json;
}

Json wrong_belief_json(const WrongBelief& wrong) {
  Json json = {{"map", wrong.map},
               {"kind", wrong.kind},
               {"frame", wrong.frame_index},
               {"confidence", wrong.confidence},
               {"translation_error_m", wrong.error.translation_m},
               {"rotation_error_deg", wrong.error.rotation_rad * kDegPerRad}};
  if (!wrong.picture.empty()) json["picture"] = wrong.picture;
  return json;
}

Json method_json(const MethodTrust& method) {
  Json json = {{"acceptance_threshold", method.acceptance_threshold},
               {"all", counts_json(method.all)},
               {"elsewhere", counts_json(method.elsewhere)},
               {"calibration_error", method.confidence.calibration_error},
               {"roc_area", method.confidence.roc_area},
               {"brier_score", method.confidence.brier_score}};
  json["kinds"] = Json::object();
  for (const std::string& kind : question_kinds()) {
    const auto found = method.kinds.find(kind);
    if (found != method.kinds.end()) json["kinds"][kind] = counts_json(found->second);
  }
  json["maps"] = Json::object();
  for (const MapTrust& map : method.maps) {
    json["maps"][map.name] = counts_json(map.beliefs);
    json["maps"][map.name]["calibration_error"] = map.confidence.calibration_error;
  }
  json["risk_coverage"] = risk_coverage_json(method.confidence);
  json["reliability"] = calibration_json(method.confidence.calibration);
  json["wrong_beliefs"] = Json::array();
  for (const WrongBelief& wrong : method.wrong_beliefs) json["wrong_beliefs"].push_back(wrong_belief_json(wrong));
  return json;
}

}  // namespace

std::string trust_tables(const std::vector<MethodTrust>& methods) {
  std::vector<std::vector<std::string>> kinds;
  std::vector<std::vector<std::string>> maps;
  for (const MethodTrust& method : methods) {
    for (const std::string& kind : question_kinds()) {
      const auto found = method.kinds.find(kind);
      if (found != method.kinds.end()) kinds.push_back(counts_row(method.method, kind, found->second));
    }
    kinds.push_back(counts_row(method.method, "all of another place", method.elsewhere));
    kinds.push_back(counts_row(method.method, "all", method.all));
    for (const MapTrust& map : method.maps) {
      maps.push_back({method.method, map.name, std::to_string(map.beliefs.num_questions), std::to_string(map.beliefs.num_right_believed),
                      std::to_string(map.beliefs.num_right_unbelieved), std::to_string(map.beliefs.num_wrong_believed),
                      format_number(map.confidence.calibration_error, 3)});
    }
    maps.push_back({method.method, "all", std::to_string(method.all.num_questions), std::to_string(method.all.num_right_believed),
                    std::to_string(method.all.num_right_unbelieved), std::to_string(method.all.num_wrong_believed),
                    format_number(method.confidence.calibration_error, 3)});
  }
  return format_table({"method", "kind", "questions", "right, believed % [95 % interval]", "right, not believed",
                       "wrong, believed [95 % interval]", "neither"},
                      kinds) +
         "\n" +
         format_table({"method", "map", "questions", "right, believed", "right, not believed", "wrong, believed", "calibration error"},
                      maps);
}

Json trust_json(const std::vector<MethodTrust>& methods) {
  Json json = Json::object();
  for (const MethodTrust& method : methods) json[method.method] = method_json(method);
  return json;
}

std::string trust_csv(const std::vector<MethodTrust>& methods) {
  std::string csv = "method,by,name,questions,right_believed,right_unbelieved,wrong_believed,wrong_unbelieved,unanswered\n";
  const auto add = [&](const std::string& method, const char* by, const std::string& name, const BeliefCounts& counts) {
    csv += csv_cell(method) + "," + by + "," + csv_cell(name);
    for (const int count : {counts.num_questions, counts.num_right_believed, counts.num_right_unbelieved, counts.num_wrong_believed,
                            counts.num_wrong_unbelieved, counts.num_unanswered()})
      csv += "," + std::to_string(count);
    csv += "\n";
  };
  for (const MethodTrust& method : methods) {
    for (const auto& [kind, counts] : method.kinds) add(method.method, "kind", kind, counts);
    for (const MapTrust& map : method.maps) add(method.method, "map", map.name, map.beliefs);
  }
  return csv;
}

}  // namespace foothold::benchmark

// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "growth.h"

#include "foothold/evaluation/text_table.h"
#include "outputs.h"

namespace foothold::benchmark {
namespace {

std::string percent(double fraction) { return format_number(100.0 * fraction, 1); }

std::string spread_text(const Spread& ms) { return format_number(ms.median, 1) + "/" + format_number(ms.p95, 1); }

double accepted_fraction(const MethodReport& report) {
  return report.num_tested == 0 ? 0.0 : static_cast<double>(report.num_accepted) / report.num_tested;
}

}  // namespace

std::string growth_table(const std::vector<GrowthCurve>& curves, const std::string& amount_name) {
  std::vector<std::vector<std::string>> rows;
  for (const GrowthCurve& curve : curves) {
    for (const GrowthPoint& point : curve.points) {
      const MethodReport& report = point.result.report;
      std::vector<std::string> row = {curve.method, std::to_string(point.amount), std::to_string(report.num_trained)};
      for (const Recall& rung : report.recall) row.push_back(percent(rung.fraction));
      row.push_back(percent(accepted_fraction(report)));
      row.push_back(std::to_string(report.num_false_accepts) + " of " + std::to_string(report.num_tested));
      row.push_back(std::to_string(point.beliefs.num_wrong_place));
      row.push_back(spread_text(report.relocalise.wall_ms));
      row.push_back(spread_text(point.first_train_ms));
      row.push_back(spread_text(point.last_train_ms));
      row.push_back(format_number(report.state_mb, 1));
      rows.push_back(std::move(row));
    }
  }
  return format_table({"method", amount_name, "learnt", "1/1 %", "2/2 %", "5/5 %", "10/10 %", "accepted %", "false accepts", "elsewhere",
                       "relocalise ms", "first train ms", "last train ms", "scene MB"},
                      rows);
}

Json growth_json(const std::vector<GrowthCurve>& curves, const std::string& amount_key) {
  Json json = Json::object();
  for (const GrowthCurve& curve : curves) {
    Json points = Json::array();
    for (const GrowthPoint& point : curve.points) {
      Json entry = {{amount_key, point.amount}};
      entry.update(accuracy_json(point.result.report));
      entry["beliefs"] = {{"right", point.beliefs.num_right},
                          {"unsure", point.beliefs.num_unsure},
                          {"wrong_here", point.beliefs.num_wrong_here},
                          {"wrong_place", point.beliefs.num_wrong_place}};
      entry["timing"] = timing_json(point.result);
      entry["timing"]["first_train_ms"] = spread_json(point.first_train_ms);
      entry["timing"]["last_train_ms"] = spread_json(point.last_train_ms);
      points.push_back(std::move(entry));
    }
    json[curve.method] = {{"points", std::move(points)}};
  }
  return json;
}

std::string growth_csv(const std::vector<GrowthCurve>& curves, const std::string& amount_key) {
  std::string csv = "method," + amount_key +
                    ",recall_1cm_1deg,recall_2cm_2deg,recall_5cm_5deg,recall_10cm_10deg,accepted,false_accepts,wrong_place,relocalise_ms,"
                    "relocalise_p95_ms,first_train_ms,last_train_ms,state_mb\n";
  for (const GrowthCurve& curve : curves) {
    for (const GrowthPoint& point : curve.points) {
      const MethodReport& report = point.result.report;
      csv += csv_cell(curve.method) + "," + std::to_string(point.amount);
      for (const Recall& rung : report.recall) csv += "," + csv_number(rung.fraction);
      csv += "," + std::to_string(report.num_accepted) + "," + std::to_string(report.num_false_accepts) + "," +
             std::to_string(point.beliefs.num_wrong_place);
      for (const double value : {report.relocalise.wall_ms.median, report.relocalise.wall_ms.p95, point.first_train_ms.median,
                                 point.last_train_ms.median, report.state_mb})
        csv += "," + csv_number(value);
      csv += "\n";
    }
  }
  return csv;
}

}  // namespace foothold::benchmark

// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "growth.h"

#include <algorithm>

#include "chart.h"
#include "foothold/evaluation/text_table.h"
#include "foothold/io/image_file.h"
#include "outputs.h"

namespace foothold::benchmark {
namespace {

std::string spread_text(const Spread& ms) { return format_number(ms.median, 1) + "/" + format_number(ms.p95, 1); }

double accepted_fraction(const MethodReport& report) {
  return report.num_tested == 0 ? 0.0 : static_cast<double>(report.num_accepted) / report.num_tested;
}

std::vector<std::string> table_row(const std::string& method, const std::string& amount, const GrowthPoint& point) {
  const MethodReport& report = point.result.report;
  std::vector<std::string> row = {method, amount, std::to_string(report.num_trained)};
  for (const Recall& rung : report.recall) row.push_back(percent(rung.fraction));
  row.push_back(percent(accepted_fraction(report)));
  row.push_back(std::to_string(report.num_false_accepts) + " of " + std::to_string(report.num_tested));
  row.push_back(std::to_string(point.beliefs.num_wrong_place));
  row.push_back(spread_text(report.relocalise.wall_ms));
  row.push_back(spread_text(point.first_train_ms));
  row.push_back(spread_text(point.last_train_ms));
  row.push_back(format_number(report.state_mb, 1));
  return row;
}

Json point_json(const GrowthPoint& point) {
  Json json = accuracy_json(point.result.report);
  json["beliefs"] = {{"right", point.beliefs.num_right},
                     {"unsure", point.beliefs.num_unsure},
                     {"wrong_here", point.beliefs.num_wrong_here},
                     {"wrong_place", point.beliefs.num_wrong_place}};
  json["timing"] = timing_json(point.result);
  json["timing"]["first_train_ms"] = spread_json(point.first_train_ms);
  json["timing"]["last_train_ms"] = spread_json(point.last_train_ms);
  return json;
}

void append(CallTimes& times, const CallTimes& more) {
  times.wall_ms.insert(times.wall_ms.end(), more.wall_ms.begin(), more.wall_ms.end());
  times.cpu_ms.insert(times.cpu_ms.end(), more.cpu_ms.begin(), more.cpu_ms.end());
  for (const auto& [stage, ms] : more.stages_ms) {
    std::vector<double>& all = times.stages_ms[stage];
    all.insert(all.end(), ms.begin(), ms.end());
  }
}

/// A curve of one number of every method's points.
template <class Value>
void add_curves(Chart& chart, const std::vector<GrowthCurve>& curves, const std::string& name, const Value& value) {
  for (const GrowthCurve& curve : curves) {
    chart.curves.push_back({curve.method + name, {}});
    for (const GrowthPoint& point : curve.points) chart.curves.back().points.emplace_back(point.amount, value(point));
  }
}

}  // namespace

PlaceBeliefs count_beliefs(const RunLog& log, const std::vector<Place>& places) {
  PlaceBeliefs counts;
  for (const TestRecord& test : log.tests) {
    if (!test.best.has_value() || test.best->confidence < log.acceptance_threshold) {
      ++counts.num_unsure;
    } else if (test.within(kWrongThreshold)) {
      ++counts.num_right;
    } else {
      const std::size_t shown = static_cast<std::size_t>(test.input_index);
      const bool here = nearest_place(places, test.best->world_from_camera.translation) == shown;
      ++(here ? counts.num_wrong_here : counts.num_wrong_place);
    }
  }
  return counts;
}

Spread train_spread(const RunLog& log, std::size_t begin, std::size_t end) {
  const auto& ms = log.train.wall_ms;
  return spread_of({ms.begin() + static_cast<std::ptrdiff_t>(begin), ms.begin() + static_cast<std::ptrdiff_t>(end)});
}

MethodResult joined(const std::vector<MethodResult>& runs) {
  MethodResult all = runs.front();
  for (std::size_t i = 1; i < runs.size(); ++i) {
    const RunLog& log = runs[i].log;
    const int num_inputs = all.log.tests.empty() ? 0 : all.log.tests.back().input_index + 1;
    for (TestRecord test : log.tests) {
      test.input_index += num_inputs;
      all.log.tests.push_back(test);
    }
    append(all.log.train, log.train);
    append(all.log.relocalise, log.relocalise);
    append(all.log.update, log.update);
    all.log.trained_world_from_camera.insert(all.log.trained_world_from_camera.end(), log.trained_world_from_camera.begin(),
                                             log.trained_world_from_camera.end());
    all.log.state_bytes += log.state_bytes;
    all.peak_mb = std::max(all.peak_mb, runs[i].peak_mb);
  }
  all.report = make_report(all.log);
  return all;
}

std::string growth_table(const std::vector<GrowthCurve>& curves, const std::string& amount_name) {
  std::vector<std::vector<std::string>> rows;
  for (const GrowthCurve& curve : curves) {
    if (curve.alone.has_value()) rows.push_back(table_row(curve.method, "each alone", *curve.alone));
    for (const GrowthPoint& point : curve.points) rows.push_back(table_row(curve.method, std::to_string(point.amount), point));
  }
  return format_table({"method", amount_name, "learnt", "1/1 %", "2/2 %", "5/5 %", "10/10 %", "accepted %", "false accepts", "elsewhere",
                       "relocalise ms", "first train ms", "last train ms", "scene MB"},
                      rows);
}

std::string belief_table(const std::vector<GrowthCurve>& curves, const std::string& amount_name) {
  std::vector<std::vector<std::string>> rows;
  for (const GrowthCurve& curve : curves) {
    for (const GrowthPoint& point : curve.points) {
      const PlaceBeliefs& beliefs = point.beliefs;
      rows.push_back({curve.method, std::to_string(point.amount)});
      for (const int count : {beliefs.num_right, beliefs.num_unsure, beliefs.num_wrong_here, beliefs.num_wrong_place})
        rows.back().push_back(std::to_string(count));
    }
  }
  return format_table({"method", amount_name, "right, believed", "unsure", "wrong, believed, right place", "wrong place, believed"}, rows);
}

Json growth_json(const std::vector<GrowthCurve>& curves, const std::string& amount_key) {
  Json json = Json::object();
  for (const GrowthCurve& curve : curves) {
    Json points = Json::array();
    for (const GrowthPoint& point : curve.points) {
      Json entry = {{amount_key, point.amount}};
      entry.update(point_json(point));
      points.push_back(std::move(entry));
    }
    json[curve.method] = Json::object();
    if (curve.alone.has_value()) json[curve.method]["alone"] = point_json(*curve.alone);
    json[curve.method]["points"] = std::move(points);
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

void write_growth_plot(const std::string& path, const std::vector<GrowthCurve>& curves, const std::string& amount_name) {
  constexpr int width = 1200;
  constexpr int height = 860;
  constexpr double margin = 24.0;
  Chart recall{"Found within 5 cm and 5 deg, and believed", amount_name, {}, 1.0, true, true};
  add_curves(recall, curves, ": found", [](const GrowthPoint& point) { return point.result.report.recall[2].fraction; });
  add_curves(recall, curves, ": believed", [](const GrowthPoint& point) { return accepted_fraction(point.result.report); });
  Chart find{"Finding the camera [ms, median]", amount_name, {}, 0.0, false, true};
  add_curves(find, curves, "", [](const GrowthPoint& point) { return point.result.report.relocalise.wall_ms.median; });
  Chart learn{"Learning a frame, of what was learnt last [ms, median]", amount_name, {}, 0.0, false, true};
  add_curves(learn, curves, "", [](const GrowthPoint& point) { return point.last_train_ms.median; });
  Chart memory{"Memory of the scene [MB]", amount_name, {}, 0.0, false, true};
  add_curves(memory, curves, "", [](const GrowthPoint& point) { return point.result.report.state_mb; });
  apps::Canvas canvas(width, height);
  const Chart* charts[] = {&recall, &find, &learn, &memory};
  for (int i = 0; i < 4; ++i) {
    const double left = margin + (i % 2) * (0.5 * width - 0.5 * margin);
    const double top = margin + (i / 2) * (0.5 * height - 0.5 * margin);
    draw_chart(canvas, {left, top, left + 0.5 * width - 2.0 * margin, top + 0.5 * height - 1.5 * margin}, *charts[i]);
  }
  write_png(path, canvas.image());
}

}  // namespace foothold::benchmark

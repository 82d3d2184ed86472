// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "scene_tables.h"

#include <algorithm>

#include "foothold/base/atomic_file.h"
#include "foothold/base/contract.h"
#include "foothold/evaluation/text_table.h"
#include "outputs.h"

namespace foothold::benchmark {
namespace {

double recall_within(const MethodReport& report, const PoseThreshold& threshold) {
  for (const Recall& recall : report.recall) {
    if (recall.threshold.key() == threshold.key()) return recall.fraction;
  }
  FOOTHOLD_EXPECTS(false && "the threshold is a rung of recall_ladder()");
  return 0.0;
}

Json names_json(const std::vector<EvaluationInput>& inputs) {
  Json names = Json::array();
  for (const EvaluationInput& input : inputs) names.push_back(input.name);
  return names;
}

/// Forests and methods in the order of the runs, each pair once.
std::vector<std::pair<std::string, std::string>> rows_of(const std::vector<SceneRun>& runs) {
  std::vector<std::pair<std::string, std::string>> rows;
  for (const SceneRun& run : runs) {
    const std::pair<std::string, std::string> row(run.forest, run.result.name);
    if (std::find(rows.begin(), rows.end(), row) == rows.end()) rows.push_back(row);
  }
  return rows;
}

}  // namespace

Json scenes_json(const std::vector<Scene>& scenes) {
  Json json = Json::array();
  for (const Scene& scene : scenes)
    json.push_back({{"name", scene.name}, {"training", names_json(scene.training)}, {"tests", names_json(scene.tests)}});
  return json;
}

Json runs_json(const std::vector<SceneRun>& runs) {
  Json json = Json::array();
  for (const SceneRun& run : runs) {
    Json entry = {{"scene", run.scene}, {"method", run.result.name}, {"forest", run.forest.empty() ? Json(nullptr) : Json(run.forest)}};
    entry.update(accuracy_json(run.result.report));
    if (!run.result.novelty.empty()) entry["novelty"] = novelty_json(run.result.novelty);
    entry["timing"] = timing_json(run.result);
    json.push_back(std::move(entry));
  }
  return json;
}

std::string runs_csv(const std::vector<SceneRun>& runs, const std::vector<Scene>& scenes) {
  std::string csv;
  for (const SceneRun& run : runs) {
    const auto scene = std::find_if(scenes.begin(), scenes.end(), [&](const Scene& each) { return each.name == run.scene; });
    BenchmarkResult one;
    one.methods = {run.result};
    for (const EvaluationInput& input : scene->tests) one.tested.push_back(input.name);
    const std::string lines = csv_document(one);
    const std::size_t header_end = lines.find('\n') + 1;
    if (csv.empty()) csv = "scene,forest," + lines.substr(0, header_end);
    for (std::size_t begin = header_end; begin < lines.size();) {
      const std::size_t end = lines.find('\n', begin) + 1;
      csv += csv_cell(run.scene) + "," + csv_cell(run.forest) + "," + lines.substr(begin, end - begin);
      begin = end;
    }
  }
  return csv;
}

double average_recall(const std::vector<SceneRun>& runs, const std::string& forest, const std::string& method,
                      const PoseThreshold& threshold) {
  double sum = 0.0;
  int count = 0;
  for (const SceneRun& run : runs) {
    if (run.forest != forest || run.result.name != method) continue;
    sum += recall_within(run.result.report, threshold);
    ++count;
  }
  return count == 0 ? 0.0 : sum / count;
}

std::string adaptation_table(const std::vector<SceneRun>& runs, const std::vector<Scene>& scenes, const PoseThreshold& threshold) {
  std::vector<std::string> header = {"forest", "method"};
  for (const Scene& scene : scenes) header.push_back(scene.name);
  header.emplace_back("average");
  std::vector<std::vector<std::string>> rows;
  for (const auto& [forest, method] : rows_of(runs)) {
    rows.push_back({forest.empty() ? "-" : forest, method});
    for (const Scene& scene : scenes) {
      const auto is_cell = [&](const SceneRun& run) {
        return run.scene == scene.name && run.forest == forest && run.result.name == method;
      };
      const auto cell = std::find_if(runs.begin(), runs.end(), is_cell);
      rows.back().push_back(cell == runs.end() ? "-" : percent(recall_within(cell->result.report, threshold)));
    }
    rows.back().push_back(percent(average_recall(runs, forest, method, threshold)));
  }
  return format_table(header, rows);
}

std::string write_documents(const CommonOptions& options, const Json& json, const std::string& csv) {
  std::string told;
  if (!options.json_file.empty()) {
    write_file_atomically(options.json_file, json.dump() + "\n");
    told += "\nresults: " + options.json_file;
  }
  if (!options.csv_file.empty()) {
    write_file_atomically(options.csv_file, csv);
    told += "\nframes: " + options.csv_file;
  }
  return told.empty() ? told : told + "\n";
}

}  // namespace foothold::benchmark

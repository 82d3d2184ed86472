// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include <cstdio>
#include <memory>

#include "commands.h"
#include "foothold/evaluation/confidence_report.h"
#include "foothold/evaluation/text_table.h"
#include "outputs.h"
#include "scene_tables.h"
#include "scenes.h"

namespace foothold::benchmark {
namespace {

/// Points of a curve that are written at most.
constexpr std::size_t kMostCurvePoints = 256;

struct MethodConfidence {
  std::string method;
  double acceptance_threshold = 0.0;
  ConfidenceReport report;
};

/// The scene with the test recordings of the next scene behind its own: views of a place that was not learnt.
Scene with_foreign_views(const std::vector<Scene>& scenes, std::size_t index) {
  Scene scene = scenes[index];
  if (scenes.size() < 2) return scene;
  const Scene& other = scenes[(index + 1) % scenes.size()];
  scene.tests.insert(scene.tests.end(), other.tests.begin(), other.tests.end());
  return scene;
}

Json point_json(const AcceptancePoint& point) {
  return {{"threshold", point.threshold},
          {"num_accepted", point.num_accepted},
          {"false_accepts", point.num_false_accepts},
          {"recall", point.recall},
          {"false_accept_rate", point.false_accept_rate}};
}

/// Evenly chosen points of the curve, both ends included.
Json curve_json(const std::vector<AcceptancePoint>& curve) {
  Json json = Json::array();
  const std::size_t count = std::min(curve.size(), kMostCurvePoints);
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t index = count < 2 ? 0 : i * (curve.size() - 1) / (count - 1);
    json.push_back(point_json(curve[index]));
  }
  return json;
}

Json method_json(const MethodConfidence& method) {
  const ConfidenceReport& report = method.report;
  return {{"num_samples", report.num_samples},
          {"num_findable", report.num_findable},
          {"num_answered", report.num_answers},
          {"acceptance_threshold", method.acceptance_threshold},
          {"roc_area", report.roc_area},
          {"calibration_error", report.calibration_error},
          {"brier_score", report.brier_score},
          {"at_threshold", point_json(report.at_threshold)},
          {"without_false_accepts", point_json(report.without_false)},
          {"curve", curve_json(report.curve)},
          {"calibration", calibration_json(report.calibration)}};
}

std::string confidence_table(const std::vector<MethodConfidence>& methods) {
  std::vector<std::vector<std::string>> rows;
  for (const MethodConfidence& method : methods) {
    const ConfidenceReport& report = method.report;
    rows.push_back({method.method, percent(report.curve.back().recall), percent(report.at_threshold.recall),
                    std::to_string(report.at_threshold.num_false_accepts) + " of " + std::to_string(report.num_samples),
                    percent(report.without_false.recall), format_number(report.without_false.threshold, 3),
                    format_number(report.roc_area, 3), format_number(report.calibration_error, 3)});
  }
  return format_table({"method", "recall %", "accepted recall %", "false accepts", "recall without any %", "from confidence", "ROC area",
                       "calibration error"},
                      rows);
}

MethodConfidence run_one(const Method& method, const MethodInputs& inputs, const SceneOptions& options, const std::vector<Scene>& scenes) {
  std::vector<ConfidenceSample> samples;
  MethodConfidence result;
  result.method = method.name;
  for (std::size_t i = 0; i < scenes.size(); ++i) {
    const Scene scene = with_foreign_views(scenes, i);
    const Protocol protocol = train_test_protocol(scene, options.num_settling_updates);
    const MethodResult run = run_method(method, inputs, options.common, protocol, method.name + " on " + scene.name);
    for (const TestRecord& test : run.log.tests)
      samples.push_back(confidence_sample(test, test.input_index < static_cast<int>(scenes[i].tests.size())));
    result.acceptance_threshold = static_cast<double>(run.log.acceptance_threshold);
  }
  result.report = make_confidence_report(samples, result.acceptance_threshold);
  return result;
}

int run_confidence(const SceneOptions& options) {
  check_outputs(options.common);
  const std::vector<Method> methods = find_methods(options.common.methods);
  const MethodInputs inputs = method_inputs(options.common, methods);
  const std::vector<Scene> scenes = open_scenes(options);
  std::vector<MethodConfidence> results;
  try {
    for (const Method& method : methods) results.push_back(run_one(method, inputs, options, scenes));
  } catch (const Interrupted&) {
    return apps::kInterrupted;
  }
  std::printf("What confidence is worth, on %d views of learnt places and %d of others\n\n%s", results.front().report.num_findable,
              results.front().report.num_samples - results.front().report.num_findable, confidence_table(results).c_str());
  Json json = document_head("confidence", describe_scene_options(options));
  json["scenes"] = scenes_json(scenes);
  json["methods"] = Json::object();
  std::string csv = "method,threshold,accepted,false_accepts,recall,false_accept_rate\n";
  for (const MethodConfidence& method : results) {
    json["methods"][method.method] = method_json(method);
    for (const AcceptancePoint& point : method.report.curve) {
      csv += csv_cell(method.method) + "," + csv_number(point.threshold) + "," + std::to_string(point.num_accepted) + "," +
             std::to_string(point.num_false_accepts) + "," + csv_number(point.recall) + "," + csv_number(point.false_accept_rate) + "\n";
    }
  }
  std::printf("%s", write_documents(options.common, json, csv).c_str());
  return apps::kSuccess;
}

}  // namespace

Command add_confidence_command(apps::CommandLine& app) {
  const auto options = std::make_shared<SceneOptions>();
  options->common.methods = {"forest", "ferns"};
  apps::CommandLine command = app.add_subcommand(
      "confidence",
      "False accepts against recall, and whether confidences come true; with several scenes, each is also asked about the next");
  add_scene_options(command, *options);
  add_forest_option(command, options->common);
  add_experiment_options(command, options->common);
  return {command, [options] { return run_confidence(*options); }};
}

}  // namespace foothold::benchmark

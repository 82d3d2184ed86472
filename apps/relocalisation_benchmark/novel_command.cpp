// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include <cstdio>
#include <memory>

#include "commands.h"
#include "foothold/evaluation/text_table.h"
#include "outputs.h"
#include "scene_tables.h"
#include "scenes.h"

namespace foothold::benchmark {
namespace {

/// One method over all scenes.
struct NoveltyCurve {
  std::string method;
  std::vector<NoveltyBin> bins;
  double area = 0.0;
};

std::vector<NoveltyCurve> curves_of(const std::vector<SceneRun>& runs, const std::vector<Method>& methods) {
  std::vector<NoveltyCurve> curves;
  for (const Method& method : methods) {
    std::vector<std::vector<NoveltyBin>> bins;
    for (const SceneRun& run : runs) {
      if (run.result.name == method.name) bins.push_back(run.result.novelty);
    }
    curves.push_back({method.name, merge_novelty_bins(bins), 0.0});
    curves.back().area = novelty_area(curves.back().bins);
  }
  return curves;
}

/// How often the first method's area holds each other method's; null where that found nothing.
Json area_ratios_json(const std::vector<NoveltyCurve>& curves) {
  Json json = Json::object();
  for (const NoveltyCurve& numerator : curves) {
    for (const NoveltyCurve& denominator : curves) {
      if (&numerator == &denominator) continue;
      json[numerator.method + " / " + denominator.method] = numerator.area / denominator.area;
    }
  }
  return json;
}

std::string area_table(const std::vector<NoveltyCurve>& curves) {
  std::vector<std::vector<std::string>> rows;
  for (const NoveltyCurve& curve : curves) {
    rows.push_back({curve.method, format_number(curve.area, 3), format_number(curve.area / curves.back().area, 2)});
  }
  return format_table({"method", "area", "times " + curves.back().method}, rows);
}

int run_novel(const SceneOptions& options) {
  check_outputs(options.common);
  const std::vector<Method> methods = find_methods(options.common.methods);
  const MethodInputs inputs = method_inputs(options.common, methods);
  const std::vector<Scene> scenes = open_scenes(options);
  std::vector<SceneRun> runs;
  try {
    for (const Method& method : methods) {
      for (const Scene& scene : scenes) {
        const Protocol protocol = train_test_protocol(scene, options.num_settling_updates);
        const std::string label = method.name + " on " + scene.name;
        runs.push_back(
            {method.uses_forest ? options.common.forest : "", scene.name, run_method(method, inputs, options.common, protocol, label)});
        runs.back().result.novelty = novelty_bins(runs.back().result.log);
      }
    }
  } catch (const Interrupted&) {
    return apps::kInterrupted;
  }
  const std::vector<NoveltyCurve> curves = curves_of(runs, methods);
  BenchmarkResult shown;
  for (const NoveltyCurve& curve : curves) {
    shown.methods.emplace_back();
    shown.methods.back().name = curve.method;
    shown.methods.back().novelty = curve.bins;
  }
  std::printf(
      "Found within 5 cm and 5 deg against the distance to the nearest learnt view\n\n%s\nArea under the curves up to 50 cm/50 deg; 1 is "
      "perfect\n\n%s",
      novelty_table(shown).c_str(), area_table(curves).c_str());
  Json json = document_head("novel", describe_scene_options(options));
  json["scenes"] = scenes_json(scenes);
  json["methods"] = Json::object();
  for (const NoveltyCurve& curve : curves) json["methods"][curve.method] = {{"novelty", novelty_json(curve.bins)}, {"area", curve.area}};
  json["area_ratios"] = area_ratios_json(curves);
  json["runs"] = runs_json(runs);
  std::printf("%s", write_documents(options.common, json, runs_csv(runs, scenes)).c_str());
  return apps::kSuccess;
}

}  // namespace

Command add_novel_command(apps::CommandLine& app) {
  const auto options = std::make_shared<SceneOptions>();
  options->common.methods = {"forest", "ferns"};
  apps::CommandLine command =
      app.add_subcommand("novel", "Recall against the distance to the nearest learnt view: the paper's section 4.3");
  add_scene_options(command, *options);
  add_forest_option(command, options->common);
  add_experiment_options(command, options->common);
  return {command, [options] { return run_novel(*options); }};
}

}  // namespace foothold::benchmark

// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include <algorithm>
#include <cstdio>
#include <memory>
#include <set>

#include "commands.h"
#include "foothold/base/error.h"
#include "outputs.h"
#include "scene_tables.h"
#include "scenes.h"

namespace foothold::benchmark {
namespace {

struct AdaptOptions {
  SceneOptions scenes;
  std::vector<std::string> forests = {"default"};
};

/// A forest with the name of its row.
struct NamedForest {
  std::string name;
  std::string file;
};

/// Splits "NAME=FILE"; a file without a name is called as it is.
std::vector<NamedForest> name_forests(const std::vector<std::string>& texts) {
  std::vector<NamedForest> forests;
  for (const std::string& text : texts) {
    const std::size_t equals = text.find('=');
    const NamedForest forest =
        equals == std::string::npos ? NamedForest{text, text} : NamedForest{text.substr(0, equals), text.substr(equals + 1)};
    if (forest.name.empty() || forest.file.empty())
      throw InvalidSettings("--forest: got '" + text + "', expected NAME=FILE, a file, 'default' or 'random'");
    for (const NamedForest& other : forests) {
      if (other.name == forest.name) throw InvalidSettings("--forest: two forests are called '" + forest.name + "'; expected each once");
    }
    forests.push_back(forest);
  }
  return forests;
}

/// A row of the table: a method, made from a forest if it uses one.
struct Row {
  std::string forest;
  Method method;
  MethodInputs inputs;
};

/// Loads every forest before anything runs.
std::vector<Row> make_rows(const AdaptOptions& options) {
  const std::vector<Method> methods = find_methods(options.scenes.common.methods);
  std::vector<Row> rows;
  for (const NamedForest& forest : name_forests(options.forests)) {
    CommonOptions common = options.scenes.common;
    common.forest = forest.file;
    const MethodInputs inputs = method_inputs(common, methods);
    for (const Method& method : methods) {
      if (method.uses_forest) rows.push_back({forest.name, method, inputs});
    }
  }
  for (const Method& method : methods) {
    if (!method.uses_forest) rows.push_back({"", method, method_inputs(options.scenes.common, {method})});
  }
  return rows;
}

Json averages_json(const std::vector<SceneRun>& runs) {
  Json json = Json::array();
  std::set<std::pair<std::string, std::string>> done;
  for (const SceneRun& run : runs) {
    if (!done.emplace(run.forest, run.result.name).second) continue;
    Json entry = {{"forest", run.forest.empty() ? Json(nullptr) : Json(run.forest)}, {"method", run.result.name}};
    for (const PoseThreshold& threshold : recall_ladder())
      entry["recall"][threshold.key()] = average_recall(runs, run.forest, run.result.name, threshold);
    json.push_back(std::move(entry));
  }
  return json;
}

int run_adapt(const AdaptOptions& options) {
  const CommonOptions& common = options.scenes.common;
  check_outputs(common);
  const std::vector<Row> rows = make_rows(options);
  const std::vector<Scene> scenes = open_scenes(options.scenes);
  std::vector<SceneRun> runs;
  try {
    for (const Row& row : rows) {
      for (const Scene& scene : scenes) {
        const std::string label = row.method.name + (row.forest.empty() ? "" : " (" + row.forest + ")") + " on " + scene.name;
        const Protocol protocol = train_test_protocol(scene, options.scenes.num_settling_updates);
        runs.push_back({row.forest, scene.name, run_method(row.method, row.inputs, common, protocol, label)});
        runs.back().result.novelty = novelty_bins(runs.back().result.log);
      }
    }
  } catch (const Interrupted&) {
    return apps::kInterrupted;
  }
  std::printf("Found within 5 cm and 5 deg, %%\n\n%s\nFound within 10 cm and 10 deg, %%\n\n%s",
              adaptation_table(runs, scenes, kFoundThreshold).c_str(), adaptation_table(runs, scenes, kWrongThreshold).c_str());
  Json json = document_head("adapt", describe_scene_options(options.scenes));
  json["settings"].erase("forest");
  json["forests"] = Json::array();
  for (const NamedForest& forest : name_forests(options.forests)) json["forests"].push_back({{"name", forest.name}, {"file", forest.file}});
  json["scenes"] = scenes_json(scenes);
  json["averages"] = averages_json(runs);
  json["runs"] = runs_json(runs);
  std::printf("%s", write_documents(common, json, runs_csv(runs, scenes)).c_str());
  return apps::kSuccess;
}

}  // namespace

Command add_adapt_command(apps::CommandLine& app) {
  const auto options = std::make_shared<AdaptOptions>();
  apps::CommandLine command = app.add_subcommand("adapt", "Adapt forests to scenes they were not trained on: the paper's Tables 1 and 2");
  add_scene_options(command, options->scenes);
  command
      .add_option("--forest", options->forests,
                  "A forest of the table's rows as [NAME=]FILE, where FILE may be 'default', or 'random' for one made from the settings "
                  "random_forest.*; repeatable")
      .repeatable()
      .show_default();
  add_experiment_options(command, options->scenes.common);
  return {command, [options] { return run_adapt(*options); }};
}

}  // namespace foothold::benchmark

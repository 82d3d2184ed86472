// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include <algorithm>
#include <cstdio>
#include <memory>

#include "commands.h"
#include "foothold/evaluation/train_test.h"
#include "growth.h"
#include "memory_input.h"
#include "outputs.h"
#include "places.h"
#include "scene_tables.h"

namespace foothold::benchmark {
namespace {

struct DwellOptions {
  CommonOptions common;
  std::string sequence;
  std::vector<int> amounts = {0, 200, 2000};
  std::string stay = "0:20";
  std::string learn = "400:500";
  std::string test = "500:600";
};

/// The parts of the recording.
struct DwellInputs {
  FrameList stay;
  EvaluationInput learn;
  EvaluationInput test;
};

GrowthPoint run_amount(const DwellOptions& options, const Method& method, const MethodInputs& inputs, const DwellInputs& parts,
                       int amount) {
  std::vector<EvaluationInput> training;
  if (amount > 0) training.push_back(noisy_input("standing", parts.stay, amount, options.common.seed));
  training.push_back(parts.learn);
  const Protocol protocol = [&](Relocaliser& relocaliser, const ProtocolOptions& protocol_options) {
    return run_train_test(relocaliser, training, {parts.test}, 0, protocol_options);
  };
  GrowthPoint point;
  point.amount = amount;
  point.result = run_method(method, inputs, options.common, protocol, method.name + ", " + std::to_string(amount) + " frames of standing");
  const MethodReport& report = point.result.report;
  point.beliefs = count_beliefs(point.result.log, {});
  const std::size_t num_trained = static_cast<std::size_t>(report.num_trained);
  const std::size_t dwelt = static_cast<std::size_t>(amount);
  // What standing costs once it is known, and what the new place costs.
  point.first_train_ms = train_spread(point.result.log, dwelt / 2, dwelt);
  point.last_train_ms = train_spread(point.result.log, dwelt, num_trained);
  return point;
}

int run_dwell(const DwellOptions& options) {
  check_outputs(options.common);
  const std::vector<Method> methods = find_methods(options.common.methods);
  const MethodInputs inputs = method_inputs(options.common, methods);
  const EvaluationInput stay = open_input(options.common, options.sequence, options.stay);
  std::vector<GrowthCurve> curves;
  try {
    const DwellInputs parts = {read_frames(stay), open_input(options.common, options.sequence, options.learn),
                               open_input(options.common, options.sequence, options.test)};
    for (const Method& method : methods) {
      curves.push_back({method.name, {}, {}});
      for (const int amount : options.amounts) curves.back().points.push_back(run_amount(options, method, inputs, parts, amount));
    }
  } catch (const Interrupted&) {
    return apps::kInterrupted;
  }
  std::printf("%s learnt again and again with fresh noise, then %s learnt and %s tested\n\n%s", stay.name.c_str(), options.learn.c_str(),
              options.test.c_str(), growth_table(curves, "standing frames").c_str());
  std::vector<std::pair<std::string, std::string>> described = describe_options(options.common);
  for (const auto& [name, value] : {std::pair("stay", &options.stay), std::pair("learn", &options.learn), std::pair("test", &options.test)})
    described.emplace_back(name, *value);
  Json json = document_head("dwell", described);
  json["sequence"] = options.sequence;
  json["methods"] = growth_json(curves, "standing_frames");
  std::printf("%s", write_documents(options.common, json, growth_csv(curves, "standing_frames")).c_str());
  if (!options.common.plot_file.empty()) {
    write_growth_plot(options.common.plot_file, curves, "frames of standing still");
    std::printf("picture: %s\n", options.common.plot_file.c_str());
  }
  return apps::kSuccess;
}

}  // namespace

Command add_dwell_command(apps::CommandLine& app) {
  const auto options = std::make_shared<DwellOptions>();
  apps::CommandLine command =
      app.add_subcommand("dwell", "What standing still costs: a few frames learnt over and over, then another part of the scene");
  command.add_option("--sequence", options->sequence, "A folder (7-Scenes, TUM RGB-D, ICL-NUIM) or synthetic:NAME?key=value").required();
  command.add_option("--standing", options->amounts, "How many frames to stand still, one run for each number")
      .comma_separated()
      .range(0, 10000000)
      .show_default();
  command.add_option("--stay", options->stay, "Frames that are played to and fro while standing, each time with fresh noise")
      .type_name("A:B")
      .show_default();
  command.add_option("--learn", options->learn, "Frames that are learnt afterwards").type_name("A:B").show_default();
  command.add_option("--test", options->test, "Frames that are tested then").type_name("A:B").show_default();
  add_forest_option(command, options->common);
  add_experiment_options(command, options->common);
  add_plot_option(command, options->common, "Draw recall, time and memory against the frames of standing to FILE.png");
  return {command, [options] { return run_dwell(*options); }};
}

}  // namespace foothold::benchmark

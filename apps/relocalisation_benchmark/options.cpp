// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "options.h"

#include <algorithm>

#include "common/override_settings.h"
#include "common/recording_options.h"
#include "common/unhurried_player.h"
#include "foothold/base/error.h"
#include "foothold/io/sequence_player.h"

namespace foothold::benchmark {
namespace {

std::string method_help() {
  std::string text = "Methods to compare, separated by commas:";
  for (const Method& method : all_methods()) text += " " + method.name + " (" + method.description + ");";
  text.back() = '.';
  return text;
}

Forest make_forest(const std::string& choice, const BenchmarkSettings& settings) {
  if (choice == "default") return default_forest();
  if (choice == "random") return make_random_forest(settings.random_forest);
  return load_forest(choice);
}

}  // namespace

void add_forest_option(apps::CommandLine& command, CommonOptions& options) {
  command.add_option("--forest", options.forest, "A forest file, 'default', or 'random' for one made from the settings random_forest.*")
      .show_default();
}

void add_experiment_options(apps::CommandLine& command, CommonOptions& options) {
  command.add_option("--method", options.methods, method_help()).comma_separated().show_default();
  command.add_option("--preset", options.preset, "Settings that method forest starts from: tuned or paper").show_default();
  command.add_option("--settings", options.settings_file,
                     "JSON file of settings, a section per method: {\"forest\": {\"pose\": {\"num_hypotheses\": 512}}}");
  command.add_option("--set", options.settings, "One setting as path=value, such as forest.pose.num_hypotheses=512; repeatable")
      .repeatable();
  command.add_option("--stride", options.stride, "Use every Nth frame").range(1, 1000000).show_default();
  command.add_option("--seed", options.seed, "Seed of every random choice").show_default();
  apps::add_device_options(command, options.device);
  apps::add_recording_options(command, options.recording);
  command.add_flag(
      "--exclusive-timing", options.exclusive_timing,
      "Decode frames between the timed calls, not beside them in a thread: slower, but what is timed has the machine to itself");
  command.add_option("--json", options.json_file, "Write the results to FILE (docs/benchmark-json.md)").type_name("FILE");
  command.add_option("--csv", options.csv_file, "Write a line per tested frame to FILE").type_name("FILE");
}

void add_plot_option(apps::CommandLine& command, CommonOptions& options, const std::string& help) {
  command.add_option("--plot", options.plot_file, help).type_name("FILE");
}

void add_common_options(apps::CommandLine& command, CommonOptions& options) {
  add_forest_option(command, options);
  add_experiment_options(command, options);
  add_plot_option(command, options, "Draw recall over time and the trajectory to FILE.png");
  command
      .add_option("--estimates", options.estimates_file,
                  "Write the estimated poses to FILE; with several methods, to FILE.METHOD.EXTENSION")
      .type_name("FILE");
}

MethodInputs method_inputs(const CommonOptions& options, const std::vector<Method>& methods) {
  MethodInputs inputs;
  inputs.settings.forest = ForestRelocaliserSettings::preset(options.preset);
  set_seeds(inputs.settings, options.seed);
  apps::override_settings(options.settings_file, options.settings, "path=value, such as forest.pose.num_hypotheses=512", inputs.settings);
  validate_settings(inputs.settings);
  const bool needs_forest = std::any_of(methods.begin(), methods.end(), [](const Method& method) { return method.uses_forest; });
  if (needs_forest) inputs.forest = std::make_shared<const Forest>(make_forest(options.forest, inputs.settings));
  return inputs;
}

std::vector<std::pair<std::string, std::string>> describe_options(const CommonOptions& options) {
  std::vector<std::pair<std::string, std::string>> described = {{"forest", options.forest},
                                                                {"preset", options.preset},
                                                                {"device", options.device.device},
                                                                {"threads", std::to_string(options.device.num_threads)},
                                                                {"stride", std::to_string(options.stride)},
                                                                {"seed", std::to_string(options.seed)},
                                                                {"exclusive_timing", options.exclusive_timing ? "true" : "false"}};
  const SequenceOptions& recording = options.recording;
  if (!recording.intrinsics.empty()) described.emplace_back("intrinsics", recording.intrinsics);
  if (recording.depth_units_per_m != 0.0) described.emplace_back("depth_scale", std::to_string(recording.depth_units_per_m));
  if (!recording.pose_convention.empty()) described.emplace_back("pose_convention", recording.pose_convention);
  return described;
}

EvaluationInput open_input(const CommonOptions& options, const std::string& sequence_spec, const std::string& range_text) {
  const std::shared_ptr<const Sequence> sequence = open_sequence(sequence_spec, apps::make_context(options.device), options.recording);
  const FrameRange range = range_text.empty() ? FrameRange{} : parse_frame_range(range_text);
  const int num_frames = sequence->num_frames();
  const int end = range.end == FrameRange::kToTheEnd ? num_frames : range.end;
  if (range.begin >= end || end > num_frames) {
    throw InvalidSettings("frames " + range_text + " of " + sequence->name() + ": expected a part of its " + std::to_string(num_frames) +
                          " frames, 0:" + std::to_string(num_frames));
  }
  std::vector<int> indices;
  for (int index = range.begin; index < end; index += options.stride) indices.push_back(index);
  const std::string name = range_text.empty() ? sequence_spec : sequence_spec + "@" + range_text;
  const bool exclusive = options.exclusive_timing;
  const auto open = [sequence, indices, exclusive]() -> std::unique_ptr<FrameSource> {
    if (exclusive) return std::make_unique<apps::UnhurriedPlayer>(sequence, indices);
    return std::make_unique<SequencePlayer>(sequence, indices);
  };
  return {name, static_cast<int>(indices.size()), open};
}

}  // namespace foothold::benchmark

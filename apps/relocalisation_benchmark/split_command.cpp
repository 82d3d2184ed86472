// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include <cstdio>
#include <memory>

#include "commands.h"
#include "foothold/evaluation/novelty.h"
#include "foothold/evaluation/train_test.h"
#include "outputs.h"
#include "run_methods.h"

namespace foothold::benchmark {
namespace {

struct SplitOptions {
  CommonOptions common;
  std::vector<std::string> training;
  std::vector<std::string> tests;
  int num_settling_updates = kDefaultSettlingUpdates;
};

std::vector<EvaluationInput> open_inputs(const CommonOptions& options, const std::vector<std::string>& sequences,
                                         std::vector<std::string>& names) {
  std::vector<EvaluationInput> inputs;
  for (const std::string& sequence : sequences) {
    inputs.push_back(open_input(options, sequence));
    names.push_back(inputs.back().name);
  }
  return inputs;
}

int run_split(const SplitOptions& options) {
  check_outputs(options.common);
  BenchmarkResult result;
  result.protocol = "split";
  const std::vector<EvaluationInput> training = open_inputs(options.common, options.training, result.training);
  const std::vector<EvaluationInput> tests = open_inputs(options.common, options.tests, result.tested);
  result.options = describe_options(options.common);
  result.options.emplace_back("settle", std::to_string(options.num_settling_updates));
  const Protocol protocol = [&](Relocaliser& relocaliser, const ProtocolOptions& protocol_options) {
    return run_train_test(relocaliser, training, tests, options.num_settling_updates, protocol_options);
  };
  if (!run_methods(options.common, protocol, result)) return apps::kInterrupted;
  for (MethodResult& method : result.methods) method.novelty = novelty_bins(method.log);
  const MethodReport& first = result.methods.front().report;
  std::printf("Learnt %d frames, tested %d others\n\n%s", first.num_trained, first.num_tested, all_tables(result).c_str());
  std::printf("%s", write_outputs(options.common, result).c_str());
  return apps::kSuccess;
}

}  // namespace

Command add_split_command(apps::CommandLine& app) {
  const auto options = std::make_shared<SplitOptions>();
  apps::CommandLine command = app.add_subcommand("split", "Learn some sequences, then find the camera in others");
  command.add_option("--train", options->training, "A sequence to learn, or a part of it as SEQUENCE@A:B; repeatable")
      .required()
      .repeatable();
  command.add_option("--test", options->tests, "A sequence to test, or a part of it as SEQUENCE@A:B; repeatable").required().repeatable();
  command
      .add_option("--settle", options->num_settling_updates, "Calls of update() between training and test, as a live system has idle time")
      .range(0, 1000000)
      .show_default();
  add_common_options(command, options->common);
  return {command, [options] { return run_split(*options); }};
}

}  // namespace foothold::benchmark

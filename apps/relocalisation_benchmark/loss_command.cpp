// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include <cstdio>
#include <memory>

#include "commands.h"
#include "common/recording_options.h"
#include "foothold/evaluation/tracking_loss.h"
#include "outputs.h"
#include "run_methods.h"

namespace foothold::benchmark {
namespace {

struct LossOptions {
  CommonOptions common;
  std::string sequence;
  std::string frames;
  int gap = 0;
};

int run_loss(const LossOptions& options) {
  check_outputs(options.common);
  const EvaluationInput input = open_input(options.common, options.sequence, options.frames);
  BenchmarkResult result;
  result.protocol = "loss";
  result.tested = {input.name};
  result.options = describe_options(options.common);
  result.options.emplace_back("gap", std::to_string(options.gap));
  const Protocol protocol = [&](Relocaliser& relocaliser, const ProtocolOptions& protocol_options) {
    return run_tracking_loss(relocaliser, input, options.gap, protocol_options);
  };
  if (!run_methods(options.common, protocol, result)) return apps::kInterrupted;
  std::printf("Tracking lost at every frame of %s%s\n\n%s", input.name.c_str(),
              options.gap > 0 ? (", gap " + std::to_string(options.gap)).c_str() : "", all_tables(result).c_str());
  std::printf("%s", write_outputs(options.common, result).c_str());
  return apps::kSuccess;
}

}  // namespace

Command add_loss_command(apps::CommandLine& app) {
  const auto options = std::make_shared<LossOptions>();
  apps::CommandLine command =
      app.add_subcommand("loss", "Relocalise every frame with what was learnt before it, then learn it with its true pose");
  command.add_option("--sequence", options->sequence, apps::kRecordingHelp).required();
  command.add_option("--frames", options->frames, "Use only frames A:B, the last one excluded").type_name("A:B");
  command.add_option("--gap", options->gap, "Test frame i + N (of those used) with what was learnt up to frame i - 1")
      .range(0, 1000000)
      .show_default();
  add_common_options(command, options->common);
  return {command, [options] { return run_loss(*options); }};
}

}  // namespace foothold::benchmark

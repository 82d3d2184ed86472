// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// relocalisation_benchmark: how well, how fast and in how much memory methods find a lost camera.
#include "commands.h"
#include "common/app_main.h"

int main(int argc, char** argv) {
  namespace benchmark = foothold::benchmark;
  foothold::apps::CommandLine app("Measures how well, how fast and in how much memory a lost camera is found.", "relocalisation_benchmark");
  app.require_subcommands(1, 1);
  const benchmark::Command commands[] = {
      benchmark::add_loss_command(app),     benchmark::add_split_command(app),  benchmark::add_adapt_command(app),
      benchmark::add_novel_command(app),    benchmark::add_time_command(app),   benchmark::add_confidence_command(app),
      benchmark::add_failures_command(app), benchmark::add_kidnap_command(app), benchmark::add_scale_command(app),
      benchmark::add_dwell_command(app),    benchmark::add_trust_command(app)};
  return foothold::apps::run_app(app, argc, argv, [&] {
    for (const benchmark::Command& command : commands) {
      if (command.line.parsed()) return command.run();
    }
    return static_cast<int>(foothold::apps::kUserError);  // unreachable: a subcommand is required
  });
}

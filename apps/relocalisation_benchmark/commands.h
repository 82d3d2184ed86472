// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// The subcommands: each adds itself to the app and returns what runs when it is chosen.
#pragma once

#include <functional>

#include "common/command_line.h"

namespace foothold::benchmark {

/// A subcommand and its body, which returns the exit code.
struct Command {
  apps::CommandLine line;
  std::function<int()> run;
};

/// "loss": tracking lost at every frame of a sequence that is being learnt.
Command add_loss_command(apps::CommandLine& app);
/// "split": learn some sequences, find the camera in others.
Command add_split_command(apps::CommandLine& app);
/// "adapt": forests pre-trained on one scene, adapted to others. Reference: [Cavallari2017] Sec. 4.1, Tables 1 and 2.
Command add_adapt_command(apps::CommandLine& app);
/// "novel": recall against the distance to the nearest learnt view. Reference: [Cavallari2017] Sec. 4.3.
Command add_novel_command(apps::CommandLine& app);
/// "time": what learning and finding cost, and how it grows. Reference: [Cavallari2017] Sec. 4.4, Table 3.
Command add_time_command(apps::CommandLine& app);
/// "confidence": false accepts against recall, and calibration.
Command add_confidence_command(apps::CommandLine& app);
/// "failures": pictures of wrong answers. Reference: [Cavallari2017], supplementary material.
Command add_failures_command(apps::CommandLine& app);
/// "kidnap": the closed loop of tracker, relocaliser and map.
Command add_kidnap_command(apps::CommandLine& app);
/// "scale": recall, time and memory against the number of places learnt in one world.
Command add_scale_command(apps::CommandLine& app);
/// "dwell": recall, time and memory after standing still.
Command add_dwell_command(apps::CommandLine& app);
/// "trust": how far answers can be trusted, by kind of question.
Command add_trust_command(apps::CommandLine& app);

}  // namespace foothold::benchmark

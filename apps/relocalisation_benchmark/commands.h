// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// The subcommands: each adds itself to the app and returns what runs when it is chosen.
#pragma once

#include <CLI/App.hpp>
#include <functional>

namespace foothold::benchmark {

/// A subcommand and its body, which returns the exit code.
struct Command {
  CLI::App* app = nullptr;
  std::function<int()> run;
};

/// "loss": tracking lost at every frame of a sequence that is being learnt.
Command add_loss_command(CLI::App& app);
/// "split": learn some sequences, find the camera in others.
Command add_split_command(CLI::App& app);

}  // namespace foothold::benchmark

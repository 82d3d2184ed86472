// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// The options that every subcommand takes.
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "common/app_main.h"
#include "foothold/base/context.h"
#include "foothold/evaluation/protocol.h"
#include "foothold/io/sequence.h"
#include "methods.h"

namespace foothold::benchmark {

/// The paper clusters 256 leaves per call; 200 calls go once round the 42,000 leaves of its forest.
inline constexpr int kDefaultSettlingUpdates = 200;

/// As typed.
struct CommonOptions {
  std::vector<std::string> methods = {"forest"};
  std::string forest = "default";
  std::string preset = "tuned";
  std::string settings_file;
  std::vector<std::string> settings;
  apps::DeviceOptions device;
  SequenceOptions recording;
  int stride = 1;
  std::uint64_t seed = 42;
  bool exclusive_timing = false;
  std::string json_file;
  std::string csv_file;
  std::string plot_file;
  std::string estimates_file;
};

/// All of them, for commands that run one protocol on one recording.
void add_common_options(apps::CommandLine& command, CommonOptions& options);
/// Those that experiments on several scenes take too: all but --forest, --plot and --estimates.
void add_experiment_options(apps::CommandLine& command, CommonOptions& options);
/// --plot, with what it draws.
void add_plot_option(apps::CommandLine& command, CommonOptions& options, const std::string& help);
/// --forest for experiments with one forest.
void add_forest_option(apps::CommandLine& command, CommonOptions& options);

/// What the methods are made from: settings from the preset, the seed, the settings file and --set, in this order, and the forest if one of
/// the methods needs it. @throws InvalidSettings, FileError
MethodInputs method_inputs(const CommonOptions& options, const std::vector<Method>& methods);

/// The options that shape a run, as names and values for the report.
std::vector<std::pair<std::string, std::string>> describe_options(const CommonOptions& options);

/// Opens a recording, or the part of it that `range` names ("A:B", or empty for all), to be played with the stride of the options.
/// @throws FileError, InvalidSettings
EvaluationInput open_input(const CommonOptions& options, const std::string& sequence, const std::string& range = {});

}  // namespace foothold::benchmark

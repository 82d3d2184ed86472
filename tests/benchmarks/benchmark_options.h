// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "foothold/base/context.h"

namespace foothold::benchmark {

/// The command line of device_benchmark.
struct Options {
  std::string action;
  Device device = Device::kCpu;
  int cuda_device = 0;
  int num_threads = 1;
  std::string sequence = "synthetic:office";
  std::string elsewhere = "synthetic:stairs";  ///< views of another place
  std::string preset = "tuned";
  std::string out;  ///< the file that `pack` writes
  int num_frames = 200;
  int num_warm_up = 50;
  int num_seconds = 60;
};

/// Nothing if the user only asked for help, which is printed. @throws InvalidSettings
std::optional<Options> parse_options(const std::vector<std::string>& arguments);

/// @throws DeviceError
Context make_context(const Options& options, Trace* trace = nullptr);

}  // namespace foothold::benchmark

// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// What the main() of every app does: parse arguments, run, turn exceptions into messages and exit codes, heed Ctrl-C.
#pragma once

#include <functional>
#include <string>

#include "common/command_line.h"
#include "common/log.h"
#include "foothold/base/context.h"

namespace foothold::apps {

/// What an app's process returns.
enum ExitCode : int {
  kSuccess = 0,
  kBug = 1,        ///< an unexpected exception
  kUserError = 2,  ///< wrong arguments, settings, files or devices: the message says what was expected
  kOutOfMemory = 3,
  kInterrupted = 130  ///< Ctrl-C or SIGTERM, as shells have it for the former
};

/// Parses the command line and calls `body`. Call it last in main() and return its result.
///
/// Wrong arguments and exceptions derived from foothold::Error are reported on stderr and give kUserError, as does a result that standard
/// output does not take; memory that runs out gives kOutOfMemory, any other exception kBug.
/// From then on Ctrl-C, the end of the terminal and SIGTERM make interrupted() true; a second one of a kind kills the process.
int run_app(CommandLine& app, int argc, char** argv, const std::function<int()>& body);

/// True once the user has pressed Ctrl-C, or the system wants the process to end. Long loops ask it, tidy up and return kInterrupted.
bool interrupted();

/// Where to compute, as every app's options say it.
struct DeviceOptions {
  std::string device = "cpu";
  int num_threads = 0;
};

/// Adds --device cpu|cuda|cuda:N and --threads N. The options must live as long as the app.
void add_device_options(CommandLine& app, DeviceOptions& options);

/// The context that the options ask for, logging to stderr. @throws InvalidSettings, DeviceError
Context make_context(const DeviceOptions& options, Trace* trace = nullptr);

}  // namespace foothold::apps

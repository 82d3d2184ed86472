// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "common/app_main.h"

#include <csignal>
#include <exception>
#include <new>

#include "foothold/base/error.h"

namespace foothold::apps {
namespace {

volatile std::sig_atomic_t interrupt_requested = 0;

void on_interrupt(int signal) {
  interrupt_requested = 1;
  std::signal(signal, SIG_DFL);  // the second Ctrl-C means it
}

}  // namespace

int run_app(CommandLine& app, int argc, char** argv, const std::function<int()>& body) {
  try {
    const std::optional<int> exit_code = app.parse(argc, argv);
    if (exit_code.has_value()) return *exit_code == 0 ? kSuccess : kUserError;
  } catch (const std::exception& error) {
    log_error(error.what());
    return kBug;
  }
  interrupt_requested = 0;
  for (const int signal : {SIGINT, SIGTERM}) std::signal(signal, on_interrupt);
  if (std::signal(SIGHUP, on_interrupt) == SIG_IGN) std::signal(SIGHUP, SIG_IGN);  // nohup means it
  try {
    return body();
  } catch (const Error& error) {
    log_error(error.what());
    return kUserError;
  } catch (const std::bad_alloc&) {
    log_error("out of memory");
    return kBug;
  } catch (const std::exception& error) {
    log_error(std::string("unexpected: ") + error.what());
    return kBug;
  }
}

bool interrupted() { return interrupt_requested != 0; }

void add_device_options(CommandLine& app, DeviceOptions& options) {
  app.add_option("--device", options.device, "Where to compute: cpu or cuda").one_of({"cpu", "cuda"}).show_default();
  app.add_option("--threads", options.num_threads, "Host threads; 0 for as many as the machine has").show_default();
}

Context make_context(const DeviceOptions& options, Trace* trace) {
  ContextOptions result;
  result.device = options.device == "cuda" ? Device::kCuda : Device::kCpu;
  result.num_threads = options.num_threads;
  result.log = log_to_stderr();
  result.trace = trace;
  return Context(result);
}

}  // namespace foothold::apps

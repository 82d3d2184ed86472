// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "common/app_main.h"

#include <spdlog/sinks/stdout_color_sinks.h>
#include <spdlog/spdlog.h>

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

/// Messages go to stderr, so that stdout holds results only.
void set_up_log(const std::string& app_name) {
  spdlog::drop(app_name);
  auto logger = spdlog::stderr_color_mt(app_name.empty() ? "foothold" : app_name);
  logger->set_pattern("%^%l%$: %v");
  spdlog::set_default_logger(logger);
}

}  // namespace

int run_app(CLI::App& app, int argc, char** argv, const std::function<int()>& body) {
  try {
    set_up_log(app.get_name());
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? kSuccess : kUserError;  // also how --help ends
  } catch (const std::exception& error) {
    spdlog::error("{}", error.what());
    return kBug;
  }
  interrupt_requested = 0;
  for (const int signal : {SIGINT, SIGTERM}) std::signal(signal, on_interrupt);
  if (std::signal(SIGHUP, on_interrupt) == SIG_IGN) std::signal(SIGHUP, SIG_IGN);  // nohup means it
  try {
    return body();
  } catch (const Error& error) {
    spdlog::error("{}", error.what());
    return kUserError;
  } catch (const std::bad_alloc&) {
    spdlog::error("out of memory");
    return kBug;
  } catch (const std::exception& error) {
    spdlog::error("unexpected: {}", error.what());
    return kBug;
  }
}

bool interrupted() { return interrupt_requested != 0; }

LogSink log_to_stderr() {
  return [](LogLevel level, const std::string& message) {
    spdlog::log(level == LogLevel::kWarning ? spdlog::level::warn : spdlog::level::info, "{}", message);
  };
}

void add_device_options(CLI::App& app, DeviceOptions& options) {
  app.add_option("--device", options.device, "Where to compute: cpu or cuda")->check(CLI::IsMember({"cpu", "cuda"}))->capture_default_str();
  app.add_option("--threads", options.num_threads, "Host threads; 0 for as many as the machine has")->capture_default_str();
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

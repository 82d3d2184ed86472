// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "common/app_main.h"

#include <fcntl.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <iostream>
#include <new>
#include <opencv2/core.hpp>
#include <system_error>

#include "foothold/base/error.h"

namespace foothold::apps {
namespace {

std::atomic<bool> interrupt_requested = false;  // atomic, since any thread may be the one that a signal interrupts
static_assert(std::atomic<bool>::is_always_lock_free, "a signal's handler must not lock");

void on_interrupt(int signal) {
  interrupt_requested = true;
  std::signal(signal, SIG_DFL);  // the second Ctrl-C means it
}

/// Sets the device that --device names.
void set_device(const std::string& text, ContextOptions& options) {
  options.device = text == "cpu" ? Device::kCpu : Device::kCuda;
  if (text == "cpu" || text == "cuda") return;
  constexpr std::size_t kPrefix = 5;
  constexpr std::size_t kMaxDigits = 3;
  if (text.rfind("cuda:", 0) != 0 || text.size() == kPrefix || text.size() > kPrefix + kMaxDigits ||
      text.find_first_not_of("0123456789", kPrefix) != std::string::npos) {
    throw InvalidSettings("--device: got '" + text + "', expected cpu, cuda or cuda:N");
  }
  options.cuda_device = std::stoi(text.substr(kPrefix));
}

/// Writes what stdout still holds. @return False, having said so, if it or anything before could not be written.
bool finish_stdout() {
  errno = 0;
  std::cout.flush();
  const bool is_complete = std::fflush(stdout) == 0 && std::cout && std::ferror(stdout) == 0;
  if (!is_complete) log_error(std::string("standard output: cannot be written: ") + std::strerror(errno != 0 ? errno : EIO));
  return is_complete;
}

/// Opens those of the three standard streams that are closed, so that no other file takes their place. What is written to them fails.
void reserve_standard_streams() {
  for (const int descriptor : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
    if (::fcntl(descriptor, F_GETFD) == -1) ::open("/dev/null", descriptor == STDIN_FILENO ? O_WRONLY : O_RDONLY);
  }
}

/// What nobody catches, as memory that runs out in a thread or where nothing may be thrown.
[[noreturn]] void on_terminate() {
  try {
    if (const std::exception_ptr error = std::current_exception()) std::rethrow_exception(error);
  } catch (const std::bad_alloc&) {
    std::fputs("error: out of memory\n", stderr);
    std::_Exit(kOutOfMemory);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "error: unexpected: %s\n", error.what());
  } catch (...) {
    std::fputs("error: unexpected\n", stderr);
  }
  std::abort();
}

/// Runs what may throw, and says what it threw.
int exit_code_of(const std::function<int()>& body) {
  try {
    return body();
  } catch (const Error& error) {
    log_error(error.what());
    return kUserError;
  } catch (const std::bad_alloc&) {
    log_error("out of memory");
    return kOutOfMemory;
  } catch (const cv::Exception& error) {
    log_error(error.code == cv::Error::StsNoMem ? "out of memory" : std::string("unexpected: ") + error.what());
    return error.code == cv::Error::StsNoMem ? kOutOfMemory : kBug;
  } catch (const std::exception& error) {
    const auto* of_system = dynamic_cast<const std::system_error*>(&error);  // as std::thread says; threads need memory, too
    const bool is_out_of_threads = (of_system != nullptr && of_system->code() == std::errc::resource_unavailable_try_again) ||
                                   std::strstr(error.what(), "pthread_create") != nullptr;  // as oneTBB says
    log_error(is_out_of_threads ? std::string("out of memory: ") + error.what() : std::string("unexpected: ") + error.what());
    return is_out_of_threads ? kOutOfMemory : kBug;
  }
}

int parse_and_run(CommandLine& app, int argc, char** argv, const std::function<int()>& body) {
  const std::optional<int> exit_code = app.parse(argc, argv);
  if (exit_code.has_value()) return *exit_code == 0 ? kSuccess : kUserError;
  interrupt_requested = false;
  for (const int signal : {SIGINT, SIGTERM}) std::signal(signal, on_interrupt);
  if (std::signal(SIGHUP, on_interrupt) == SIG_IGN) std::signal(SIGHUP, SIG_IGN);  // nohup means it
  return body();
}

}  // namespace

int run_app(CommandLine& app, int argc, char** argv, const std::function<int()>& body) {
  std::set_terminate(on_terminate);
  reserve_standard_streams();
  const int code = exit_code_of([&] { return parse_and_run(app, argc, argv, body); });
  return finish_stdout() || code != kSuccess ? code : kUserError;
}

bool interrupted() { return interrupt_requested; }

void add_device_options(CommandLine& app, DeviceOptions& options) {
  app.add_option("--device", options.device, "Where to compute: cpu, cuda, or cuda:N for the GPU of that index")
      .type_name("cpu|cuda[:N]")
      .show_default();
  app.add_option("--threads", options.num_threads, "Host threads; 0 for as many as the machine has").show_default();
}

Context make_context(const DeviceOptions& options, Trace* trace) {
  ContextOptions result;
  set_device(options.device, result);
  result.num_threads = options.num_threads;
  result.log = log_to_stderr();
  result.trace = trace;
  return Context(result);
}

}  // namespace foothold::apps

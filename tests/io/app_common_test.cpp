// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// The code that the apps share.
#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <new>

#include "common/app_main.h"
#include "common/progress_bar.h"
#include "foothold/base/error.h"
#include "io_fixtures.h"
#include "support/catch.h"

namespace foothold::apps {
namespace {

using Catch::Matchers::Contains;

/// What a call writes to stderr while that is not a terminal.
template <class Call>
std::string stderr_of(Call&& call) {
  const test::TempFolder temp;
  const int file = ::open((temp / "stderr.txt").c_str(), O_WRONLY | O_CREAT, 0600);
  std::fflush(stderr);
  const int old = ::dup(STDERR_FILENO);
  ::dup2(file, STDERR_FILENO);
  call();
  std::fflush(stderr);
  ::dup2(old, STDERR_FILENO);
  ::close(old);
  ::close(file);
  return test::read_text(temp / "stderr.txt");
}

/// Runs an app of one required option.
struct Outcome {
  int exit_code = 0;
  std::string messages;
};
Outcome run(std::vector<std::string> arguments, const std::function<int()>& body) {
  Outcome outcome;
  outcome.messages = stderr_of([&] {
    CommandLine app("An app.", "an_app");
    std::string value;
    app.add_option("--value", value, "A value").required();
    arguments.insert(arguments.begin(), "an_app");
    std::vector<char*> argv;
    for (std::string& argument : arguments) argv.push_back(argument.data());
    outcome.exit_code = run_app(app, static_cast<int>(argv.size()), argv.data(), body);
  });
  return outcome;
}

}  // namespace

TEST_CASE("run_app: returns what the body returns") {
  const Outcome outcome = run({"--value", "1"}, [] { return 7; });
  CHECK(outcome.exit_code == 7);
  CHECK(outcome.messages.empty());
}

TEST_CASE("run_app: mistakes of the user give exit code 2 and the message") {
  const Outcome file = run({"--value", "1"}, []() -> int { throw FileError("a.txt: no such file"); });
  CHECK(file.exit_code == kUserError);
  CHECK(file.messages == "error: a.txt: no such file\n");
  const Outcome arguments = run({"--valve", "1"}, [] { return 0; });
  CHECK(arguments.exit_code == kUserError);
  CHECK_THAT(arguments.messages, Contains("--value"));
}

TEST_CASE("run_app: anything else that is thrown gives exit code 1") {
  CHECK(run({"--value", "1"}, []() -> int { throw std::logic_error("bug"); }).exit_code == kBug);
}

TEST_CASE("run_app: memory that runs out gives exit code 3 and says so") {
  const Outcome memory = run({"--value", "1"}, []() -> int { throw std::bad_alloc(); });
  CHECK(memory.exit_code == kOutOfMemory);
  CHECK_THAT(memory.messages, Contains("out of memory"));
}

TEST_CASE("run_app: the first Ctrl-C, hang-up or request to end only raises a flag") {
  const int signal = GENERATE(SIGINT, SIGTERM, SIGHUP);
  std::signal(signal, SIG_DFL);  // the tests themselves may run under nohup
  const Outcome outcome = run({"--value", "1"}, [&] {
    CHECK_FALSE(interrupted());
    std::raise(signal);
    return interrupted() ? kInterrupted : kSuccess;
  });
  CHECK(outcome.exit_code == kInterrupted);
}

TEST_CASE("run_app: a hang-up that is ignored, as under nohup, stays so") {
  std::signal(SIGHUP, SIG_IGN);
  const Outcome outcome = run({"--value", "1"}, [] {
    std::raise(SIGHUP);
    return interrupted() ? kInterrupted : kSuccess;
  });
  std::signal(SIGHUP, SIG_DFL);
  CHECK(outcome.exit_code == kSuccess);
}

TEST_CASE("make_context: a device is cpu, cuda or cuda:N, and any other text is refused") {
  CHECK(make_context({"cpu", 1}).device() == Device::kCpu);
  for (const char* text : {"", "gpu", "CUDA", "cpu:0", "cuda:", "cuda:x", "cuda:1x", "cuda:-1", "cuda: 1", "cuda:1000", "cuda0"}) {
    INFO(text);
    CHECK_THROWS_WITH(make_context({text, 1}), Contains("--device: got '" + std::string(text) + "', expected cpu, cuda or cuda:N"));
  }
  // No machine has so many, but it is a device.
  CHECK_THROWS_WITH(make_context({"cuda:999", 1}), !Contains("--device"));
}

TEST_CASE("ProgressBar: elsewhere than on a terminal, a line every tenth of the way") {
  const std::string output = stderr_of([] {
    ProgressBar bar("working", 1000);
    for (int i = 0; i < 1000; ++i) bar.advance();
  });
  CHECK(std::count(output.begin(), output.end(), '\n') == 10);
  CHECK_THAT(output, Contains("working: 10 % (100 of 1000)") && Contains("left") && Contains("working: 100 % (1000 of 1000), took"));
}

TEST_CASE("ProgressBar: nothing to do shows nothing") {
  CHECK(stderr_of([] {
          ProgressBar bar("working", 0);
          bar.advance();
        }).empty());
}

TEST_CASE("duration_text: reads well at every length") {
  CHECK(duration_text(0.4) == "0 s");
  CHECK(duration_text(59.4) == "59 s");
  CHECK(duration_text(59.6) == "1 min 00 s");
  CHECK(duration_text(185.0) == "3 min 05 s");
  CHECK(duration_text(7800.0) == "2 h 10 min");
}

}  // namespace foothold::apps

// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "foothold/base/context.h"

#include <string>
#include <vector>

#include "foothold/base/array.h"
#include "foothold/base/error.h"
#include "support/catch.h"
#include "support/error_message.h"

namespace foothold {
namespace {

TEST_CASE("Context: runs on the host with the threads asked for") {
  ContextOptions options;
  options.num_threads = 3;
  const Context context(options);
  REQUIRE(context.device() == Device::kCpu);
  REQUIRE(context.memory() == MemoryKind::kHost);
  REQUIRE(context.num_threads() == 3);
  REQUIRE(context.stream() == nullptr);
  REQUIRE(context.trace() == nullptr);
  REQUIRE_NOTHROW(context.synchronise());
  REQUIRE(Context().num_threads() >= 1);
}

TEST_CASE("Context: refuses impossible thread counts, naming value and range") {
  for (const int count : {-1, 1025}) {
    ContextOptions options;
    options.num_threads = count;
    const std::string message = test::error_message<InvalidSettings>([&] { Context{options}; });
    REQUIRE(test::contains(message, "num_threads"));
    REQUIRE(test::contains(message, std::to_string(count)));
    REQUIRE(test::contains(message, "[0, 1024]"));
  }
}

TEST_CASE("Context: says why there is no CUDA device") {
  std::string reason;
  if (cuda_available(&reason)) return;
  REQUIRE_FALSE(reason.empty());
  ContextOptions options;
  options.device = Device::kCuda;
  REQUIRE_FALSE(test::error_message<DeviceError>([&] { Context{options}; }).empty());
  REQUIRE_FALSE(test::error_message<DeviceError>([] { Array<int>(MemoryKind::kCuda, 16); }).empty());
}

TEST_CASE("Context: copies share, two contexts do not") {
  const Context first;
  const Context copy = first;
  const Context second;
  REQUIRE(copy.arena() == first.arena());
  REQUIRE(second.arena() != first.arena());
}

TEST_CASE("Context: hands messages to its sink, and drops them without one") {
  std::vector<std::string> messages;
  ContextOptions options;
  options.log = [&](LogLevel level, const std::string& text) {
    messages.push_back((level == LogLevel::kWarning ? "warning: " : "") + text);
  };
  const Context context(options);
  context.log(LogLevel::kInfo, "one");
  context.log(LogLevel::kWarning, "two");
  REQUIRE(messages == std::vector<std::string>{"one", "warning: two"});
  REQUIRE_NOTHROW(Context().log(LogLevel::kWarning, "nobody hears"));
}

TEST_CASE("ScopedStage: adds its lifetime to the trace under its name") {
  Trace trace;
  ContextOptions options;
  options.trace = &trace;
  const Context context(options);
  for (int i = 0; i < 3; ++i) {
    const ScopedStage outer(context, "outer");
    const ScopedStage inner(context, "outer/inner");
  }
  REQUIRE(trace.stages().size() == 2);
  REQUIRE(trace.stages().at("outer").size() == 3);
  for (int i = 0; i < 3; ++i) {
    const auto run = static_cast<std::size_t>(i);
    REQUIRE(trace.stages().at("outer/inner")[run] >= 0.0);
    REQUIRE(trace.stages().at("outer")[run] >= trace.stages().at("outer/inner")[run]);
  }
}

}  // namespace
}  // namespace foothold

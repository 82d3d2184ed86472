// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "foothold/base/background_queue.h"

#include <atomic>
#include <cstdint>
#include <future>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "foothold/base/exec/cpu_executor.h"
#include "foothold/base/trace.h"
#include "support/catch.h"
#include "support/error_message.h"
#include "support/logged_warnings.h"

namespace foothold {
namespace {

Context threads(int num_threads, Trace* trace = nullptr) {
  ContextOptions options;
  options.num_threads = num_threads;
  options.trace = trace;
  return Context(options);
}

/// The sum of the squares below n, by a loop on the context's threads.
std::uint64_t sum_of_squares(const Context& context, std::size_t n) {
  std::atomic<std::uint64_t> sum{0};
  CpuExecutor(context).for_each(n, [&](std::size_t i) { sum += i * i; });
  return sum;
}

TEST_CASE("BackgroundQueue: makes calls in order, and waiting ends behind the last") {
  BackgroundQueue queue(threads(2));
  REQUIRE(queue.is_beside());
  std::vector<int> made;
  for (int round = 0; round < 20; ++round) {
    for (int i = 0; i < round; ++i) queue.add([&made, i] { made.push_back(i); });
    queue.wait();
    REQUIRE(made.size() == static_cast<std::size_t>(round));
    for (int i = 0; i < round; ++i) REQUIRE(made[static_cast<std::size_t>(i)] == i);
    made.clear();
  }
  queue.wait();  // for nothing
}

TEST_CASE("BackgroundQueue: its caller goes on while a call is made") {
  BackgroundQueue queue(threads(2));
  std::promise<void> gone_on;
  bool made = false;
  queue.add([&] {
    gone_on.get_future().wait();
    made = true;
  });
  gone_on.set_value();  // never reached if add() made the call
  queue.wait();
  REQUIRE(made);
}

TEST_CASE("BackgroundQueue: loops of its calls and of its caller run at once on one arena, and none takes up a call") {
  const Context context = threads(2);
  BackgroundQueue queue(context);
  const std::thread::id caller = std::this_thread::get_id();
  std::atomic<bool> in_loop{false};
  bool taken_up = false;
  std::uint64_t sum_of_calls = 0;
  for (int i = 0; i < 50; ++i) {
    queue.add([&] {
      taken_up = taken_up || (in_loop && std::this_thread::get_id() == caller);
      sum_of_calls += sum_of_squares(context, 3000);
    });
  }
  std::uint64_t sum = 0;
  in_loop = true;
  for (int i = 0; i < 50; ++i) sum += sum_of_squares(context, 3000);
  in_loop = false;
  queue.wait();
  REQUIRE_FALSE(taken_up);
  REQUIRE(sum == 50 * sum_of_squares(threads(1), 3000));
  REQUIRE(sum_of_calls == sum);
}

TEST_CASE("BackgroundQueue: what a call throws is thrown once, those behind it are forgotten, and the queue goes on") {
  BackgroundQueue queue(threads(2));
  std::promise<void> added;
  std::string made;
  queue.add([&] {
    added.get_future().wait();
    throw std::runtime_error("no more");
  });
  queue.add([&] { made += "forgotten"; });
  added.set_value();
  REQUIRE(test::error_of<std::runtime_error>([&] { queue.wait(); }) == "no more");
  REQUIRE_NOTHROW(queue.wait());
  queue.add([&] { made += "b"; });
  queue.wait();
  REQUIRE(made == "b");
}

TEST_CASE("BackgroundQueue: what a call threw is thrown by the next that is added, too") {
  BackgroundQueue queue(threads(2));
  queue.add([] { throw std::runtime_error("no more"); });
  std::string error;
  int num_made = 0;
  while (error.empty()) {  // the first may be behind the one that throws
    error = test::error_message<std::runtime_error>([&] { queue.add([&] { ++num_made; }); });
    std::this_thread::yield();
  }
  REQUIRE(error == "no more");
  queue.wait();
  REQUIRE(num_made == 0);
}

TEST_CASE("BackgroundQueue: destruction waits, and tells of a call that threw") {
  test::LoggedWarnings log;
  int num_made = 0;
  {
    BackgroundQueue queue(log.context());
    for (int i = 0; i < 5; ++i) {
      queue.add([&] {
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
        ++num_made;
      });
    }
    queue.add([] { throw std::runtime_error("no more"); });
  }
  REQUIRE(num_made == 5);
  REQUIRE(log.warnings.size() == 1);
  REQUIRE(test::contains(log.warnings.front(), "no more"));
}

TEST_CASE("BackgroundQueue: with one thread, or a trace, calls are made by whoever adds them") {
  Trace trace;
  for (const Context& context : {threads(1), threads(2, &trace)}) {
    BackgroundQueue queue(context);
    REQUIRE_FALSE(queue.is_beside());
    std::thread::id maker;
    queue.add([&] { maker = std::this_thread::get_id(); });
    REQUIRE(maker == std::this_thread::get_id());
    REQUIRE_THROWS_AS(queue.add([] { throw std::runtime_error("at once"); }), std::runtime_error);
    REQUIRE_NOTHROW(queue.wait());
  }
}

TEST_CASE("Context: messages of its calls and of its caller reach the sink one at a time") {
  test::LoggedWarnings log;
  const Context context = log.context();
  BackgroundQueue queue(context);
  constexpr std::size_t kNumMessages = 200;
  const auto tell = [&] {
    for (std::size_t i = 0; i < kNumMessages; ++i) context.log(LogLevel::kWarning, "something");
  };
  queue.add(tell);
  tell();
  queue.wait();
  REQUIRE(log.warnings.size() == 2 * kNumMessages);
}

}  // namespace
}  // namespace foothold

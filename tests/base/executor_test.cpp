// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// The host's executor against the standard library, with 1, 2 and 4 threads.
#include <algorithm>
#include <atomic>
#include <new>
#include <numeric>
#include <thread>
#include <vector>

#include "foothold/base/exec/cpu_executor.h"
#include "support/catch.h"
#include "support/random_seed.h"

namespace foothold {
namespace {

Context context_with(int num_threads) {
  ContextOptions options;
  options.num_threads = num_threads;
  return Context(options);
}

/// Below, at and above the grain of a parallel loop.
const std::vector<std::size_t> kSizes = {0, 1, 255, 256, 257, 10000};

TEST_CASE("CpuExecutor::for_each: visits every index once") {
  for (const int num_threads : {1, 2, 4}) {
    const Context context = context_with(num_threads);
    const CpuExecutor executor(context);
    for (const std::size_t size : kSizes) {
      std::vector<std::atomic<int>> visits(size);
      executor.for_each(size, [&](std::size_t i) { ++visits[i]; });
      REQUIRE(std::all_of(visits.begin(), visits.end(), [](const auto& count) { return count == 1; }));
    }
  }
}

TEST_CASE("CpuExecutor::for_each_team: gives each item a team with scratch memory of its own") {
  struct Scratch {
    int values[64];
    int counter;
  };
  for (const int num_threads : {1, 2, 4}) {
    const Context context = context_with(num_threads);
    const CpuExecutor executor(context);
    std::vector<int> sums(500, -1);
    executor.for_each_team<Scratch>(sums.size(), [&](auto team, Scratch& scratch, std::size_t item) {
      if (team.lane() == 0) scratch.counter = 0;
      team.sync();
      for (int i = team.lane(); i < 64; i += team.size()) {
        scratch.values[i] = i * static_cast<int>(item);
        team.fetch_add(scratch.counter, 1);
      }
      team.sync();
      int partial = 0;
      for (int i = team.lane(); i < 64; i += team.size()) partial += scratch.values[63 - i];
      const int total = team.sum(partial);
      if (team.lane() == 0) sums[item] = total + scratch.counter;
    });
    for (std::size_t item = 0; item < sums.size(); ++item) REQUIRE(sums[item] == static_cast<int>(item) * (63 * 64 / 2) + 64);
  }
}

TEST_CASE("CpuTeam: sums of one lane are the lane's own, and fetch_add returns the former value") {
  constexpr CpuTeam team;
  REQUIRE(team.lane() == 0);
  REQUIRE(team.size() == 1);
  REQUIRE(team.sum(2.5F) == 2.5F);
  float values[3] = {1.0F, 2.0F, 3.0F};
  team.sum_all(values);
  REQUIRE(values[2] == 3.0F);
  REQUIRE(team.lowest(7) == 7);
  REQUIRE(team.highest(-7) == -7);
  int counter = 5;
  REQUIRE(team.fetch_add(counter, 3) == 5);
  REQUIRE(counter == 8);
}

TEST_CASE("CpuExecutor::exclusive_scan: sums what came before, the total last") {
  Random random = test::test_random();
  for (const int num_threads : {1, 2, 4}) {
    const Context context = context_with(num_threads);
    const CpuExecutor executor(context);
    for (const std::size_t size : kSizes) {
      std::vector<std::uint32_t> in(size);
      for (std::uint32_t& value : in) value = random.below(1000);
      std::vector<std::uint32_t> expected(size + 1, 0);
      std::partial_sum(in.begin(), in.end(), expected.begin() + 1);
      std::vector<std::uint32_t> out(size + 1, 77);
      executor.exclusive_scan(Span<const std::uint32_t>(in), out);
      REQUIRE(out == expected);
    }
  }
}

TEST_CASE("CpuExecutor::sort: is std::stable_sort by the chosen bits") {
  Random random = test::test_random();
  const std::pair<int, int> kBitRanges[] = {{0, 64}, {0, 11}, {0, 12}, {5, 17}, {32, 64}, {63, 64}, {10, 10}};
  for (const int num_threads : {1, 2, 4}) {
    const Context context = context_with(num_threads);
    const CpuExecutor executor(context);
    Array<std::uint64_t> buffer;
    for (const std::size_t size : {std::size_t{0}, std::size_t{1}, std::size_t{2}, std::size_t{1000}, std::size_t{70000}}) {
      for (const auto& [low, high] : kBitRanges) {
        std::vector<std::uint64_t> keys(size);
        // Few distinct values in each byte, so that ties show whether the sort is stable.
        for (std::uint64_t& key : keys) key = ((static_cast<std::uint64_t>(random.bits()) << 32U) | random.bits()) & 0xC3C3C3C3C3C3C3C3ULL;
        std::vector<std::uint64_t> expected = keys;
        const int num_bits = high - low;
        const std::uint64_t mask = num_bits == 64 ? ~std::uint64_t{0} : ((std::uint64_t{1} << num_bits) - 1) << low;
        std::stable_sort(expected.begin(), expected.end(), [&](std::uint64_t a, std::uint64_t b) { return (a & mask) < (b & mask); });
        executor.sort(keys, buffer, low, high);
        REQUIRE(keys == expected);
      }
    }
  }
}

TEST_CASE("CpuExecutor: works with as many threads as asked for") {
  for (const int num_threads : {1, 2, 4}) {
    const Context context = context_with(num_threads);
    std::atomic<int> arrived{0};
    // Each body waits, for a bounded time, until all threads have arrived: only so many threads can meet.
    std::atomic<int> most{0};
    CpuExecutor(context).for_each_team<int>(static_cast<std::size_t>(num_threads), [&](CpuTeam, int&, std::size_t) {
      ++arrived;
      const Stopwatch watch;
      while (arrived < num_threads && watch.elapsed_ms() < 2000.0) std::this_thread::yield();
      most = std::max(most.load(), arrived.load());
    });
    REQUIRE(most == num_threads);
  }
}

TEST_CASE("run_on_threads: covers the range in pieces, and an exception reaches the caller") {
  for (const int num_threads : {1, 3}) {
    for (const std::size_t size : kSizes) {
      std::vector<std::atomic<int>> visits(size);
      detail::run_on_threads(num_threads, size, 256, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) ++visits[i];
      });
      REQUIRE(std::all_of(visits.begin(), visits.end(), [](const auto& count) { return count == 1; }));
    }
    REQUIRE_THROWS_AS(detail::run_on_threads(num_threads, 10, 1, [](std::size_t, std::size_t) { throw std::bad_alloc(); }), std::bad_alloc);
  }
}

TEST_CASE("CpuExecutor: loops may nest in a context of their own") {
  const Context outer = context_with(2);
  const Context inner = context_with(2);
  std::vector<std::atomic<int>> visits(1000);
  CpuExecutor(outer).for_each_team<int>(
      4, [&](CpuTeam, int&, std::size_t) { CpuExecutor(inner).for_each(visits.size(), [&](std::size_t i) { ++visits[i]; }); });
  REQUIRE(std::all_of(visits.begin(), visits.end(), [](const auto& count) { return count == 4; }));
}

TEST_CASE("CpuExecutor: an exception in a body reaches the caller") {
  for (const int num_threads : {1, 4}) {
    const Context context = context_with(num_threads);
    const CpuExecutor executor(context);
    REQUIRE_THROWS_AS(executor.for_each(10000,
                                        [](std::size_t i) {
                                          if (i == 7777) throw std::bad_alloc();
                                        }),
                      std::bad_alloc);
  }
}

}  // namespace
}  // namespace foothold

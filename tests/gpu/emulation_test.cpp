// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// The emulated device itself: that it notices what would go wrong on a real one.
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <cstdio>
#include <cstdlib>

#include "foothold/base/array.h"
#include "foothold/base/error.h"
#include "gpu/device.h"
#include "support/catch.h"
#include "support/emulated_cuda/emulated_cuda_executor.h"

namespace foothold {
namespace {

/// True if a process that does this dies of it.
template <class Deed>
bool is_deadly(const Deed& deed) {
  std::fflush(nullptr);
  const pid_t child = ::fork();
  if (child == 0) {
    if (std::freopen("/dev/null", "w", stderr) == nullptr) std::_Exit(0);
    for (const int signal : {SIGSEGV, SIGABRT}) std::signal(signal, SIG_DFL);
    deed();
    std::_Exit(0);
  }
  int status = 0;
  ::waitpid(child, &status, 0);
  return !WIFEXITED(status) || WEXITSTATUS(status) != 0;
}

TEST_CASE("emulated CUDA: the host dies of device memory, kernels do not") {
  const Context context = test::context_on(Device::kCuda);
  Array<int> array(MemoryKind::kCuda, 100);
  int* const data = array.data();
  REQUIRE(is_deadly([&] { data[3] = 1; }));
  REQUIRE_FALSE(is_deadly([&] {
    CudaExecutor(context).for_each(100, [data](std::size_t i) { data[i] = 1; });
    context.synchronise();
  }));
}

TEST_CASE("emulated CUDA: a kernel that writes past the end of device memory dies") {
  const Context context = test::context_on(Device::kCuda);
  Array<int> array(MemoryKind::kCuda, 64);
  int* const data = array.data();
  REQUIRE(is_deadly([&] {
    CudaExecutor(context).for_each(1, [data](std::size_t) { data[64] = 1; });
    context.synchronise();
  }));
}

TEST_CASE("emulated CUDA: kernels run no sooner than the host waits") {
  const Context context = test::context_on(Device::kCuda);
  int runs = 0;
  CudaExecutor(context).for_each(2, [&runs](std::size_t) { ++runs; });
  REQUIRE(runs == 0);
  context.synchronise();
  REQUIRE(runs == 2);
}

TEST_CASE("emulated CUDA: a kernel that touches another device's memory dies") {
  const Context first = test::context_on(Device::kCuda);
  const Context second = test::context_on(Device::kCuda, 1, 1);
  Array<int> array(second.memory(), 64);
  int* const data = array.data();
  const auto touch_on = [data](const Context& context) {
    CudaExecutor(context).for_each(64, [data](std::size_t i) { data[i] = 1; });
    context.synchronise();
  };
  REQUIRE(is_deadly([&] { touch_on(first); }));
  REQUIRE_FALSE(is_deadly([&] { touch_on(second); }));
}

TEST_CASE("emulated CUDA: streams that do not wait for each other find what was there before") {
  const Context writer = test::context_on(Device::kCuda);
  const Context reader = test::context_on(Device::kCuda);
  Array<int> array(writer.memory(), 1);
  array.clear_to_zero();
  const int value = 7;
  array.assign(writer, Span<const int>(&value, 1));
  REQUIRE(array.read(reader, 0) == 0);
  reader.wait_for(writer);
  REQUIRE(array.read(reader, 0) == 7);
}

TEST_CASE("emulated CUDA: lanes of one team that come to different barriers die") {
  const Context context = test::context_on(Device::kCuda);
  REQUIRE(is_deadly([&] {
    CudaExecutor(context).for_each_team(1, [](const CudaTeam& team, std::size_t) {
      if (team.lane() == 0) team.sync();
    });
    context.synchronise();
  }));
}

TEST_CASE("Array: a copy that fails leaks no memory and changes nothing") {
  test::EmulatedCuda& device = test::EmulatedCuda::instance();
  const std::vector<int> numbers{1, 2, 3};
  Array<int> array(MemoryKind::kCuda, Span<const int>(numbers));
  const auto check_failure = [&](const auto& deed) {
    device.reset_counts();
    device.fail_next_copy();
    CHECK_THROWS_AS(deed(), CudaError);
    CHECK(device.counts().num_allocations == 1);
    CHECK(device.counts().num_frees == 1);
    CHECK(array.to_host() == numbers);
  };
  check_failure([&] { Array<int> copy(array); });
  check_failure([&] { Array<int> copy(MemoryKind::kCuda, Span<const int>(numbers)); });
  check_failure([&] { array.reserve(100); });
}

}  // namespace
}  // namespace foothold

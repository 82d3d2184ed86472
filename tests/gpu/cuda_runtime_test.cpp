// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// Foothold's own CUDA code against a fake of the CUDA runtime: devices, streams, and what users are told when CUDA fails.
#include <algorithm>
#include <string>
#include <vector>

#include "foothold/base/array.h"
#include "foothold/base/context.h"
#include "foothold/base/error.h"
#include "gpu/device.h"
#include "gpu/executor_verbs.h"
#include "support/catch.h"
#include "support/error_message.h"
#include "support/fake_cuda_runtime/fake_cuda_runtime.h"

namespace foothold {
namespace {

using test::contains;
using test::FakeCudaRuntime;

/// The runtime as a program finds it.
FakeCudaRuntime& fresh_runtime() {
  FakeCudaRuntime& cuda = FakeCudaRuntime::instance();
  cuda.reset();
  return cuda;
}

ContextOptions on_device(int cuda_device) {
  ContextOptions options;
  options.device = Device::kCuda;
  options.cuda_device = cuda_device;
  return options;
}

/// What the user reads when CUDA says this to a function that a new context calls.
std::string message_when(const std::string& function, int status) {
  FakeCudaRuntime& cuda = fresh_runtime();
  cuda.failures[function] = status;
  std::string reason;
  REQUIRE_FALSE(cuda_available(&reason));
  const std::string message = test::error_message<DeviceError>([] { Context{on_device(0)}; });
  REQUIRE(message == reason);
  REQUIRE(cuda.last_error == test::kCudaSuccess);  // nothing is left for the program's next call to find
  return message;
}

TEST_CASE("CUDA runtime: a missing driver, a missing device and missing code are told apart, each with what to do") {
  REQUIRE(contains(message_when("cudaGetDeviceCount", test::kCudaInsufficientDriver), "driver is missing or older than this build's CUDA"));
  REQUIRE(contains(message_when("cudaGetDeviceCount", test::kCudaNoDevice), "CUDA_VISIBLE_DEVICES"));
  for (const int status : {test::kCudaNoKernelImage, test::kCudaInvalidDeviceFunction, test::kCudaUnsupportedPtx}) {
    REQUIRE(contains(message_when("cudaFuncGetAttributes", status),
                     "no code for Fake 0, architecture 90: configure it with FOOTHOLD_CUDA_ARCHITECTURES=90"));
  }
  REQUIRE(contains(message_when("cudaFuncGetAttributes", test::kCudaIllegalAddress), "in a new process only"));
  fresh_runtime().num_devices = 0;
  REQUIRE(contains(test::error_message<DeviceError>([] { Context{on_device(0)}; }), "CUDA_VISIBLE_DEVICES"));
}

TEST_CASE("CUDA runtime: full memory is told with what is free") {
  FakeCudaRuntime& cuda = fresh_runtime();
  const Context context(on_device(0));
  cuda.failures["cudaMalloc"] = test::kCudaOutOfMemory;
  const std::string message = test::error_message<CudaError>([&] { Array<int>(context.memory(), 100); });
  REQUIRE(contains(message, "cudaMalloc"));
  REQUIRE(contains(message, "123 of the device's 8000 MB are free"));
  REQUIRE(cuda.last_error == test::kCudaSuccess);
}

TEST_CASE("CUDA runtime: everything happens on the context's device, and the thread's own is what it was") {
  FakeCudaRuntime& cuda = fresh_runtime();
  for (const int own : {0, 1}) {
    cuda.reset();
    cuda.current_device = own;
    const auto is_own_again = [&] { return cuda.current_device == own; };
    const Context context(on_device(1));
    REQUIRE(is_own_again());
    REQUIRE(context.device_name() == "Fake 1");
    Array<int> array(context.memory(), 10);
    const std::vector<int> values(1000, 3);
    array.assign(context, Span<const int>(values));
    REQUIRE(array.to_host() == values);
    array.clear_to_zero();
    Array<int> copy = array;
    REQUIRE(is_own_again());
    test::run_for_each(context, 300);
    test::run_exclusive_scan(context, std::vector<std::uint32_t>(1000, 1));
    test::run_sort(context, std::vector<std::uint64_t>(100000, 1), 0, 32);
    context.synchronise();
    REQUIRE(is_own_again());
    REQUIRE_FALSE(cuda.launches.empty());
    for (const test::FakeCudaLaunch& launch : cuda.launches) {
      REQUIRE(launch.device == 1);
      REQUIRE(launch.stream == context.stream());
    }
    REQUIRE(std::all_of(cuda.allocation_devices.begin(), cuda.allocation_devices.end(), [](int device) { return device == 1; }));
    if (own == 1) REQUIRE(cuda.num_set_devices == 0);
  }
}

TEST_CASE("CUDA runtime: the thread's device is restored when a call fails") {
  FakeCudaRuntime& cuda = fresh_runtime();
  const Context context(on_device(1));
  for (const char* function : {"cudaMalloc", "__cudaLaunchKernel", "cudaMemcpyAsync", "cudaStreamSynchronize"}) {
    INFO(function);
    cuda.failures = {{function, test::kCudaInvalidValue}};
    REQUIRE(contains(test::error_message<CudaError>([&] { test::run_for_each(context, 300); }), "status 1"));
    REQUIRE(cuda.current_device == 0);
    REQUIRE(cuda.last_error == test::kCudaSuccess);
  }
  cuda.failures.clear();
  REQUIRE_NOTHROW(test::run_for_each(context, 300));
}

TEST_CASE("CUDA runtime: an error that the program left behind is not Foothold's, and is not lost") {
  FakeCudaRuntime& cuda = fresh_runtime();
  std::vector<std::string> messages;
  ContextOptions options = on_device(0);
  options.log = [&](LogLevel level, const std::string& text) {
    REQUIRE(level == LogLevel::kWarning);
    messages.push_back(text);
  };
  const Context context(options);
  cuda.last_error = test::kCudaInvalidValue;
  REQUIRE_NOTHROW(test::run_for_each(context, 300));
  REQUIRE_NOTHROW(test::run_sort(context, std::vector<std::uint64_t>(1000, 1), 0, 32));
  REQUIRE(messages.size() == 1);
  REQUIRE(contains(messages[0], "status 1"));
  REQUIRE(cuda.last_error == test::kCudaSuccess);
}

TEST_CASE("CUDA runtime: a host's stream is used as it is, and must be of the context's device") {
  FakeCudaRuntime& cuda = fresh_runtime();
  ContextOptions options = on_device(1);
  options.cuda_stream = test::fake_cuda_stream(1);
  {
    const Context context(options);
    REQUIRE(context.stream() == *options.cuda_stream);
    test::run_for_each(context, 300);
    REQUIRE(cuda.launches.back().stream == *options.cuda_stream);
  }
  REQUIRE(cuda.calls["cudaStreamCreateWithFlags"] == 0);
  REQUIRE(cuda.calls["cudaStreamDestroy"] == 0);
  options.cuda_device = 0;
  const std::string message = test::error_message<InvalidSettings>([&] { Context{options}; });
  REQUIRE(contains(message, "cuda_stream"));
  REQUIRE(contains(message, "of CUDA device 1, expected one of device 0"));
  options.cuda_stream = nullptr;  // the default stream is every device's
  options.cuda_device = 1;
  REQUIRE_NOTHROW(test::run_for_each(Context(options), 300));
}

TEST_CASE("CUDA runtime: contexts wait for each other across devices, and stages are timed on them") {
  FakeCudaRuntime& cuda = fresh_runtime();
  Trace trace;
  ContextOptions options = on_device(1);
  options.trace = &trace;
  const Context first(on_device(0));
  const Context second(options);
  first.wait_for(second);
  second.wait_for(first);
  REQUIRE(cuda.calls["cudaStreamWaitEvent"] == 2);
  for (int i = 0; i < 2; ++i) {
    const ScopedStage outer(second, "outer");
    const ScopedStage inner(second, "inner");
  }
  REQUIRE(trace.stages().at("outer").size() == 2);
  REQUIRE(trace.stages().at("inner") == std::vector<double>{1.5, 1.5});
  REQUIRE(cuda.calls["cudaEventSynchronize"] == 2);
  REQUIRE(cuda.current_device == 0);
}

TEST_CASE("CUDA runtime: kernels are launched in blocks that cover their items") {
  FakeCudaRuntime& cuda = fresh_runtime();
  const Context context(on_device(0));
  for (const std::size_t n : {1, 127, 128, 129, 5000}) {
    cuda.launches.clear();
    test::run_for_each(context, n);
    REQUIRE(cuda.launches.size() == 1);
    REQUIRE(contains(cuda.launches[0].kernel, "Square"));
    REQUIRE(std::size_t{cuda.launches[0].num_blocks} * cuda.launches[0].num_threads >= n);
    REQUIRE((std::size_t{cuda.launches[0].num_blocks} - 1) * cuda.launches[0].num_threads < n);
  }
  cuda.launches.clear();
  test::run_team_verbs(context, 37, 5);
  REQUIRE(cuda.launches.size() == 1);
  REQUIRE(cuda.launches[0].num_blocks == 37);
}

}  // namespace
}  // namespace foothold

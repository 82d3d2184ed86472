// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// The CUDA runtime library played by the host: what stands between Foothold's own CUDA code, compiled by nvcc as ever, and a driver.
///
/// A program that links it runs cuda_backend.cu, cuda_devices.cu and cuda_executor.cuh on a machine without a GPU. Device memory is host
/// memory that remembers its device, kernels are launched and counted but do nothing, and every call can be made to fail. Where CUDA would
/// refuse a call, such as a launch on a stream of another device than the current one, this does, too.
#pragma once

#include <cstddef>
#include <functional>
#include <map>
#include <string>
#include <vector>

namespace foothold::test {

/// The numbers of some cudaError_t, for tests that must not see CUDA's headers.
enum FakeCudaStatus : int {
  kCudaSuccess = 0,
  kCudaInvalidValue = 1,
  kCudaOutOfMemory = 2,
  kCudaInsufficientDriver = 35,
  kCudaInvalidDeviceFunction = 98,
  kCudaNoDevice = 100,
  kCudaNoKernelImage = 209,
  kCudaUnsupportedPtx = 222,
  kCudaInvalidHandle = 400,
  kCudaIllegalAddress = 700,
};

struct FakeCudaLaunch {
  std::string kernel;  ///< its demangled name
  int device;
  const void* stream;
  unsigned num_blocks;
  unsigned num_threads;  ///< of a block
};

/// The state of the runtime: tests set it and look at it.
struct FakeCudaRuntime {
  static FakeCudaRuntime& instance();
  void reset() { *this = FakeCudaRuntime{}; }

  int num_devices = 2;
  int architecture = 90;
  int current_device = 0;
  int last_error = kCudaSuccess;
  /// Fills what the host reads from a device, in place of the kernels that did nothing; the memory is zero otherwise.
  std::function<void(void* host, std::size_t num_bytes)> answer;
  std::map<std::string, int> failures;  ///< what a function of this name, such as "cudaMalloc", returns instead of doing anything

  std::vector<FakeCudaLaunch> launches;
  std::vector<int> allocation_devices;  ///< of each cudaMalloc()
  std::map<std::string, int> calls;     ///< how often functions were called
  int num_set_devices = 0;
};

/// The architectures that nvcc compiled the program's kernels for, e.g. 75 and 90; ascending.
std::vector<int> compiled_architectures();

/// A stream of a device, as a host makes it. Never freed.
void* fake_cuda_stream(int device);

}  // namespace foothold::test

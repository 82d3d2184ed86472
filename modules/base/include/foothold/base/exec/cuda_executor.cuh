// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// The CUDA executor: the verbs of cpu_executor.h as kernels on the context's stream. Included by .cu files only.
#pragma once

#include <cub/device/device_radix_sort.cuh>
#include <cub/device/device_scan.cuh>

#include <cstddef>
#include <cstdint>
#include <string>

#include "foothold/base/array.h"
#include "foothold/base/context.h"
#include "foothold/base/error.h"
#include "foothold/base/exec/cuda_call.cuh"
#include "foothold/base/span.h"

namespace foothold {

/// The lanes of one thread block.
struct CudaTeam {
  static constexpr int kSize = 128;

  __device__ static int lane() { return static_cast<int>(threadIdx.x); }
  __device__ static constexpr int size() { return kSize; }
  __device__ static void sync() { __syncthreads(); }

  template <class T>
  __device__ static T sum(T value) {
    T values[1] = {value};
    sum_all(values);
    return values[0];
  }

  /// The order of additions is fixed, so that the result does not depend on scheduling.
  template <class T, int kCount>
  __device__ __forceinline__ static void sum_all(T (&values)[kCount]) {
    combine(values, [](T a, T b) { return a + b; });
  }

  template <class T>
  __device__ static T lowest(T value) {
    T values[1] = {value};
    combine(values, [](T a, T b) { return b < a ? b : a; });
    return values[0];
  }

  template <class T>
  __device__ static T highest(T value) {
    T values[1] = {value};
    combine(values, [](T a, T b) { return a < b ? b : a; });
    return values[0];
  }

  __device__ static int fetch_add(int& counter, int value) { return atomicAdd(&counter, value); }

 private:
  static constexpr int kWarpSize = 32;
  static constexpr int kWarps = kSize / kWarpSize;
  static_assert(kSize % kWarpSize == 0, "shuffles name all lanes of a warp");

  /// Combines the lanes' values within warps by a tree, then the warps' in order. Loops unroll, so that the values stay in registers.
  template <class T, int kCount, class Operation>
  __device__ __forceinline__ static void combine(T (&values)[kCount], const Operation& operation) {
    __shared__ __align__(16) T partial[kCount][kWarps];
#pragma unroll
    for (int k = 0; k < kCount; ++k) {
#pragma unroll
      for (int offset = kWarpSize / 2; offset > 0; offset /= 2) {
        values[k] = operation(values[k], __shfl_down_sync(0xffffffffU, values[k], offset));
      }
      if (lane() % kWarpSize == 0) partial[k][lane() / kWarpSize] = values[k];
    }
    __syncthreads();
#pragma unroll
    for (int k = 0; k < kCount; ++k) {
      values[k] = partial[k][0];
#pragma unroll
      for (int w = 1; w < kWarps; ++w) values[k] = operation(values[k], partial[k][w]);
    }
    __syncthreads();  // the next combination may use the same memory
  }
};

namespace detail {
template <class Body>
__global__ void for_each_kernel(std::size_t n, Body body) {
  const std::size_t i = static_cast<std::size_t>(blockIdx.x) * blockDim.x + threadIdx.x;
  if (i < n) body(i);
}

template <class Body>
__global__ void __launch_bounds__(CudaTeam::kSize) for_each_team_kernel(Body body) {
  body(CudaTeam{}, static_cast<std::size_t>(blockIdx.x));
}

template <class Scratch, class Body>
__global__ void __launch_bounds__(CudaTeam::kSize) for_each_team_with_scratch_kernel(Body body) {
  __shared__ __align__(16) unsigned char bytes[sizeof(Scratch)];
  body(CudaTeam{}, *reinterpret_cast<Scratch*>(bytes), static_cast<std::size_t>(blockIdx.x));
}
}  // namespace detail

/// While one exists, the context's device is the calling thread's current one.
class CudaExecutor {
 public:
  using Team = CudaTeam;
  static constexpr Device kDevice = Device::kCuda;
  static constexpr MemoryKind kMemory = MemoryKind::kCuda;
  static constexpr int kVectorWidth = 1;

  explicit CudaExecutor(const Context& context)
      : context_(context), stream_(static_cast<cudaStream_t>(context.stream())), device_(context.memory().cuda_device) {
    FOOTHOLD_CUDA_CHECK(device_.status());
    clear_foreign_error();
  }

  template <class Body>
  void for_each(std::size_t n, const Body& body) const {
    if (n == 0) return;
    constexpr unsigned kBlock = 128;
    detail::for_each_kernel<<<static_cast<unsigned>((n + kBlock - 1) / kBlock), kBlock, 0, stream_>>>(n, body);
    FOOTHOLD_CUDA_CHECK(cudaGetLastError());
  }

  template <class Body>
  void for_each_team(std::size_t n, const Body& body) const {
    if (n == 0) return;
    detail::for_each_team_kernel<<<static_cast<unsigned>(n), CudaTeam::kSize, 0, stream_>>>(body);
    FOOTHOLD_CUDA_CHECK(cudaGetLastError());
  }

  template <class Scratch, class Body>
  void for_each_team(std::size_t n, const Body& body) const {
    if (n == 0) return;
    detail::for_each_team_with_scratch_kernel<Scratch><<<static_cast<unsigned>(n), CudaTeam::kSize, 0, stream_>>>(body);
    FOOTHOLD_CUDA_CHECK(cudaGetLastError());
  }

  void exclusive_scan(Span<const std::uint32_t> in, Span<std::uint32_t> out) const {
    if (in.empty()) {
      FOOTHOLD_CUDA_CHECK(cudaMemsetAsync(out.data(), 0, sizeof(std::uint32_t), stream_));
      return;
    }
    // An inclusive scan shifted by one: an exclusive one over n + 1 elements would read one too many.
    std::size_t num_bytes = 0;
    const auto scan = [&](void* scratch) {
      return cub::DeviceScan::InclusiveSum(scratch, num_bytes, in.data(), out.data() + 1, in.size(), stream_);
    };
    FOOTHOLD_CUDA_CHECK(scan(nullptr));
    FOOTHOLD_CUDA_CHECK(scan(detail::cuda_scratch(context_, num_bytes)));
    FOOTHOLD_CUDA_CHECK(cudaMemsetAsync(out.data(), 0, sizeof(std::uint32_t), stream_));
  }

  void sort(Span<std::uint64_t> keys, Array<std::uint64_t>& buffer, int low_bit, int high_bit) const {
    if (keys.empty() || low_bit == high_bit) return;
    buffer.resize(keys.size());
    cub::DoubleBuffer<std::uint64_t> both(keys.data(), buffer.data());
    std::size_t num_bytes = 0;
    const auto sort_keys = [&](void* scratch) {
      return cub::DeviceRadixSort::SortKeys(scratch, num_bytes, both, keys.size(), low_bit, high_bit, stream_);
    };
    FOOTHOLD_CUDA_CHECK(sort_keys(nullptr));
    FOOTHOLD_CUDA_CHECK(sort_keys(detail::cuda_scratch(context_, num_bytes)));
    if (both.Current() != keys.data()) {
      FOOTHOLD_CUDA_CHECK(
          cudaMemcpyAsync(keys.data(), both.Current(), keys.size() * sizeof(std::uint64_t), cudaMemcpyDeviceToDevice, stream_));
    }
  }

  void synchronise() const { FOOTHOLD_CUDA_CHECK(cudaStreamSynchronize(stream_)); }

 private:
  /// After a launch CUDA tells the last error of the thread, which may be one that the program left there before it called Foothold.
  void clear_foreign_error() const {
    const cudaError_t status = cudaGetLastError();
    if (status == cudaSuccess) return;
    context_.log(LogLevel::kWarning, std::string("a CUDA call of the program has failed before it called Foothold, unnoticed until now: ") +
                                         cudaGetErrorString(status) + " (" + cudaGetErrorName(status) + ")");
  }

  const Context& context_;
  cudaStream_t stream_;
  detail::CudaDeviceScope device_;
};

}  // namespace foothold

// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "cuda_backend.h"

#include <cuda_runtime.h>

#include "foothold/base/error.h"
#include "foothold/base/exec/cuda_executor.cuh"

namespace foothold::detail {
namespace {

class CudaStreamImpl final : public CudaStream {
 public:
  CudaStreamImpl() { FOOTHOLD_CUDA_CHECK(cudaStreamCreateWithFlags(&stream_, cudaStreamNonBlocking)); }
  ~CudaStreamImpl() override {
    cudaStreamSynchronize(stream_);
    cudaFree(scratch_);
    cudaStreamDestroy(stream_);
  }
  CudaStreamImpl(const CudaStreamImpl&) = delete;
  CudaStreamImpl& operator=(const CudaStreamImpl&) = delete;

  void* stream() const override { return stream_; }
  void* scratch(std::size_t num_bytes) override {
    if (num_bytes > scratch_bytes_) {
      synchronise();
      FOOTHOLD_CUDA_CHECK(cudaFree(scratch_));
      scratch_ = nullptr;
      scratch_bytes_ = 0;
      FOOTHOLD_CUDA_CHECK(cudaMalloc(&scratch_, num_bytes));
      scratch_bytes_ = num_bytes;
    }
    return scratch_;
  }
  void synchronise() const override { FOOTHOLD_CUDA_CHECK(cudaStreamSynchronize(stream_)); }

 private:
  cudaStream_t stream_ = nullptr;
  void* scratch_ = nullptr;
  std::size_t scratch_bytes_ = 0;
};

/// Launched once to learn whether this build holds code for the device's architecture.
__global__ void probe_kernel() {}

}  // namespace

void check_cuda(cudaError_t status, const char* call, const char* file, int line) {
  if (status == cudaSuccess) return;
  throw CudaError(std::string(call) + " failed at " + file + ":" + std::to_string(line) + ": " + cudaGetErrorString(status));
}

bool cuda_backend_available(std::string* reason) {
  int num_devices = 0;
  cudaError_t status = cudaGetDeviceCount(&num_devices);
  if (status == cudaSuccess && num_devices == 0) status = cudaErrorNoDevice;
  if (status == cudaSuccess) {
    cudaFuncAttributes attributes{};
    status = cudaFuncGetAttributes(&attributes, probe_kernel);
  }
  if (status == cudaSuccess) return true;
  if (reason != nullptr) *reason = std::string("no usable CUDA device: ") + cudaGetErrorString(status);
  return false;
}

std::unique_ptr<CudaStream> make_cuda_stream() {
  std::string reason;
  if (!cuda_backend_available(&reason)) throw DeviceError(reason);
  return std::make_unique<CudaStreamImpl>();
}

void* cuda_allocate(std::size_t num_bytes) {
  void* pointer = nullptr;
  FOOTHOLD_CUDA_CHECK(cudaMalloc(&pointer, num_bytes));
  return pointer;
}

void cuda_free(void* pointer) noexcept { cudaFree(pointer); }

// Streams of contexts do not wait for the default stream, so copies between frames wait for the whole device first.
void cuda_copy(void* to, const void* from, std::size_t num_bytes) {
  FOOTHOLD_CUDA_CHECK(cudaDeviceSynchronize());
  FOOTHOLD_CUDA_CHECK(cudaMemcpy(to, from, num_bytes, cudaMemcpyDefault));
  FOOTHOLD_CUDA_CHECK(cudaDeviceSynchronize());
}

void cuda_clear(void* pointer, std::size_t num_bytes) {
  FOOTHOLD_CUDA_CHECK(cudaDeviceSynchronize());
  FOOTHOLD_CUDA_CHECK(cudaMemset(pointer, 0, num_bytes));
  FOOTHOLD_CUDA_CHECK(cudaDeviceSynchronize());
}

}  // namespace foothold::detail

// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// What surrounds a call into CUDA: the device it is meant for, and the check of its status. Included by .cu files only.
#pragma once

#include <cuda_runtime.h>

namespace foothold::detail {

/// Does nothing after success. @throws CudaError with the call's text, CUDA's own words and what can be done about it.
void check_cuda(cudaError_t status, const char* call, const char* file, int line);

#define FOOTHOLD_CUDA_CHECK(call) ::foothold::detail::check_cuda((call), #call, __FILE__, __LINE__)

/// Makes a device the calling thread's current one, and gives the thread its own back in the end: hosts with several GPUs have theirs.
class CudaDeviceScope {
 public:
  explicit CudaDeviceScope(int device) noexcept {
    status_ = cudaGetDevice(&before_);
    if (status_ != cudaSuccess || before_ == device) return;
    status_ = cudaSetDevice(device);
    is_changed_ = status_ == cudaSuccess;
  }
  ~CudaDeviceScope() {
    if (is_changed_) cudaSetDevice(before_);
  }
  CudaDeviceScope(const CudaDeviceScope&) = delete;
  CudaDeviceScope& operator=(const CudaDeviceScope&) = delete;

  /// Whether the device is the current one now.
  cudaError_t status() const { return status_; }

 private:
  int before_ = 0;
  bool is_changed_ = false;
  cudaError_t status_;
};

}  // namespace foothold::detail

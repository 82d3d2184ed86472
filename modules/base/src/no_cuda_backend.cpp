// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "cuda_backend.h"

#include "foothold/base/error.h"

namespace foothold::detail {
namespace {
constexpr const char* kReason =
    "this build of Foothold has no CUDA; configure it with FOOTHOLD_CUDA=ON on a machine with nvcc, or compute on the cpu";
}  // namespace

std::unique_ptr<CudaStream> make_cuda_stream(const std::optional<void*>&) { throw DeviceError(kReason); }
bool cuda_backend_available(std::string* reason) {
  if (reason != nullptr) *reason = kReason;
  return false;
}
void* cuda_allocate(std::size_t) { throw DeviceError(kReason); }
void cuda_free(void*) noexcept {}
void cuda_copy(void*, const void*, std::size_t) { throw DeviceError(kReason); }
void cuda_clear(void*, std::size_t) { throw DeviceError(kReason); }

}  // namespace foothold::detail

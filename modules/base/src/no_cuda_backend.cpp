// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "cuda_backend.h"

#include "foothold/base/error.h"

namespace foothold::detail {
namespace {
constexpr const char* kReason =
    "this build of Foothold has no CUDA; configure it with FOOTHOLD_CUDA=ON on a machine with nvcc, or compute on the cpu";
}  // namespace

std::unique_ptr<CudaStream> make_cuda_stream(int, const std::optional<void*>&) { throw DeviceError(kReason); }
void expect_usable_cuda_device(int) { throw DeviceError(kReason); }
std::string cuda_device_name(int) { throw DeviceError(kReason); }
void* cuda_allocate(int, std::size_t) { throw DeviceError(kReason); }
void cuda_free(int, void*) noexcept {}
void cuda_copy(const Memory&, void*, const Memory&, const void*, std::size_t) { throw DeviceError(kReason); }
void cuda_clear(int, void*, std::size_t) { throw DeviceError(kReason); }

}  // namespace foothold::detail

// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// What fusion.cu instantiates, for the emulated device.
#include "support/emulated_cuda/emulated_cuda_executor.h"

#include "icp_kernels.h"
#include "raycaster_kernels.h"
#include "tsdf_kernels.h"
#include "view_check_kernels.h"

namespace foothold {

template <>
struct ExecutorOf<Device::kCuda> {
  using Type = CudaExecutor;
};

template struct TsdfOps<Device::kCuda>;
template struct RaycasterOps<Device::kCuda>;
template struct IcpOps<Device::kCuda>;
template struct ViewCheckOps<Device::kCuda>;

}  // namespace foothold

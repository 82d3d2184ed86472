// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// Makes CudaExecutor the executor of Device::kCuda, and instantiates every operation for it. Included by fusion.cu, and by the emulated
/// device of the tests, behind the executor's header.
#pragma once

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

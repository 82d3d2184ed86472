// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "foothold/base/exec/cuda_executor.cuh"

#include "icp/icp_tracker_kernels.h"

namespace foothold {

template struct IcpAlgorithms<CudaExecutor>;

}  // namespace foothold

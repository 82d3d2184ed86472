// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "foothold/base/exec/cuda_executor.cuh"

#include "tsdf/tsdf_volume_kernels.h"

namespace foothold {

template struct TsdfAlgorithms<CudaExecutor>;

}  // namespace foothold

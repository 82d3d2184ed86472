// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "foothold/base/exec/cuda_executor.cuh"

#include "raycast/raycaster_kernels.h"

namespace foothold {

template struct RaycastAlgorithms<CudaExecutor>;

}  // namespace foothold

// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "foothold/base/exec/cuda_executor.cuh"

#include "pose/pose_estimator_kernels.h"

namespace foothold {

template struct PoseAlgorithms<CudaExecutor>;

}  // namespace foothold

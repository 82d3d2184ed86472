// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "foothold/base/exec/cuda_executor.cuh"

#include "clustering/leaf_modes_kernels.h"

namespace foothold {

template struct ClusteringAlgorithms<CudaExecutor>;

}  // namespace foothold

// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "foothold/base/exec/cuda_executor.cuh"

#include "reservoirs/leaf_reservoirs_kernels.h"

namespace foothold {

template struct ReservoirAlgorithms<CudaExecutor>;

}  // namespace foothold

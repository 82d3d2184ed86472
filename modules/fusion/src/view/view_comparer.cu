// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "foothold/base/exec/cuda_executor.cuh"

#include "view/view_comparer_kernels.h"

namespace foothold {

template struct ViewAlgorithms<CudaExecutor>;

}  // namespace foothold

// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "foothold/base/exec/cuda_executor.cuh"

#include "examples/examples_algorithms.h"

namespace foothold {

template struct ExampleAlgorithms<CudaExecutor>;

}  // namespace foothold

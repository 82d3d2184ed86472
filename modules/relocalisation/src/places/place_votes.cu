// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "foothold/base/exec/cuda_executor.cuh"

#include "places/place_votes_kernels.h"

namespace foothold {

template struct VotingAlgorithms<CudaExecutor>;

}  // namespace foothold

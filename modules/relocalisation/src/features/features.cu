// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "foothold/base/exec/cuda_executor.cuh"

#include "features/feature_image_kernels.h"
#include "features/leaf_lookup_kernels.h"

namespace foothold {

template struct FeatureImageAlgorithms<CudaExecutor>;
template struct LeafLookupAlgorithms<CudaExecutor>;

}  // namespace foothold

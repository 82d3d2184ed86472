// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// What the .cu files of module relocalisation instantiate, for the emulated device.
#include "support/emulated_cuda/emulated_cuda_executor.h"

#include "clustering/leaf_modes_kernels.h"
#include "examples/examples_algorithms.h"
#include "features/feature_image_kernels.h"
#include "features/leaf_lookup_kernels.h"
#include "places/place_votes_kernels.h"
#include "pose/pose_estimator_kernels.h"
#include "reservoirs/leaf_reservoirs_kernels.h"

namespace foothold {

template struct FeatureImageAlgorithms<CudaExecutor>;
template struct LeafLookupAlgorithms<CudaExecutor>;
template struct ExampleAlgorithms<CudaExecutor>;
template struct ReservoirAlgorithms<CudaExecutor>;
template struct ClusteringAlgorithms<CudaExecutor>;
template struct VotingAlgorithms<CudaExecutor>;
template struct PoseAlgorithms<CudaExecutor>;

}  // namespace foothold

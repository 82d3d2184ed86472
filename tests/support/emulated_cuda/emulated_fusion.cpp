// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// What the .cu files of module fusion instantiate, for the emulated device.
#include "support/emulated_cuda/emulated_cuda_executor.h"

#include "icp/icp_tracker_kernels.h"
#include "raycast/raycaster_kernels.h"
#include "tsdf/tsdf_volume_kernels.h"
#include "view/view_comparer_kernels.h"

namespace foothold {

template struct TsdfAlgorithms<CudaExecutor>;
template struct RaycastAlgorithms<CudaExecutor>;
template struct IcpAlgorithms<CudaExecutor>;
template struct ViewAlgorithms<CudaExecutor>;

}  // namespace foothold

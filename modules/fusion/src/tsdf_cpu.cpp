// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "cpu_ops.h"
#include "tsdf_kernels.h"

template struct foothold::TsdfOps<foothold::Device::kCpu>;

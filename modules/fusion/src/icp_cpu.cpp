// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "cpu_ops.h"
#include "icp_kernels.h"

template struct foothold::IcpOps<foothold::Device::kCpu>;

// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "cpu_ops.h"
#include "view_check_kernels.h"

template struct foothold::ViewCheckOps<foothold::Device::kCpu>;

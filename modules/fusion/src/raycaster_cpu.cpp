// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "cpu_ops.h"
#include "raycaster_kernels.h"

template struct foothold::RaycasterOps<foothold::Device::kCpu>;

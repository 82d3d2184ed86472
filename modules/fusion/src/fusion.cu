// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "foothold/base/exec/cuda_executor.cuh"

#include "cuda_ops.h"

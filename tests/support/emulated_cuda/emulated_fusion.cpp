// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// fusion.cu for the emulated device.
#include "support/emulated_cuda/emulated_cuda_executor.h"

#include "cuda_ops.h"

// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "support/emulated_cuda/emulated_cuda_executor.h"

#include "gpu/executor_verbs_impl.h"

// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// Makes the host's executor the one of Device::kCpu. Included by NAME_cpu.cpp only.
#pragma once

#include "dispatch.h"
#include "foothold/base/exec/cpu_executor.h"

namespace foothold {

template <>
struct ExecutorOf<Device::kCpu> {
  using Type = CpuExecutor;
};

}  // namespace foothold

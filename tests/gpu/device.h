// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// The tests of this folder compare Device::kCuda with Device::kCpu. They are built twice: for a real GPU where nvcc is present (labelled
/// gpu, skipped without a device), and everywhere for the emulated one of support/emulated_cuda/.
#pragma once

#include "foothold/base/context.h"

namespace foothold::test {

/// True in the program that emulates the device.
bool device_is_emulated();

/// Lanes add floats in another order than the host; poses that follow from the sums may differ by this much.
inline constexpr float kPoseTolerance_m = 1e-3F;
inline constexpr float kPoseTolerance_rad = 1e-3F;

inline Context context_on(Device device, int num_threads = 1, int cuda_device = 0) {
  ContextOptions options;
  options.device = device;
  options.cuda_device = cuda_device;
  options.num_threads = num_threads;
  return Context(options);
}

}  // namespace foothold::test

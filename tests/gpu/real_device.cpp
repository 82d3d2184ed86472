// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "gpu/device.h"

#include <cstdlib>

#include "support/run_condition.h"

namespace foothold::test {
namespace {

/// Tests are skipped without a device, unless the environment says that there has to be one.
std::string why_not_here() {
  std::string reason;
  if (cuda_available(&reason) || std::getenv("FOOTHOLD_REQUIRE_GPU") != nullptr) return {};
  return reason;
}

const bool condition_set = set_run_condition(why_not_here);

}  // namespace

bool device_is_emulated() { return false; }

}  // namespace foothold::test

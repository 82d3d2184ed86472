// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// Lets a test program say that it cannot run here, so that its tests are skipped rather than passed.
#pragma once

#include <string>

namespace foothold::test {

/// What a test program returns, and CTest's property SKIP_RETURN_CODE, where its tests cannot run.
inline constexpr int kSkipped = 77;

/// Returns why the tests of this program cannot run here; empty if they can.
using RunCondition = std::string (*)();

/// Makes main() ask before it runs a test. Call it from a static initialiser. Returns true.
bool set_run_condition(RunCondition condition);

}  // namespace foothold::test

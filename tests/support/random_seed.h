// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#pragma once

#include "foothold/base/random.h"

namespace foothold::test {

/// The random sequence of the running test: seeded by its name, or by FOOTHOLD_TEST_SEED from the environment to explore others.
Random test_random();

}  // namespace foothold::test

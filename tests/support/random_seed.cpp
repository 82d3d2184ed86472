// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "support/random_seed.h"

#include <cstdlib>
#include <functional>
#include <string>

#include "support/catch.h"

namespace foothold::test {

Random test_random() {
  const char* chosen = std::getenv("FOOTHOLD_TEST_SEED");
  std::uint64_t seed = 14695981039346656037ULL;  // FNV-1a, so that the seed does not depend on the standard library
  for (const char c : Catch::getResultCapture().getCurrentTestName()) seed = (seed ^ static_cast<unsigned char>(c)) * 1099511628211ULL;
  return Random(chosen != nullptr ? std::strtoull(chosen, nullptr, 10) : seed, 0);
}

}  // namespace foothold::test

// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#if __has_include(<catch2/catch_all.hpp>)
#include <catch2/catch_session.hpp>
#else
#define CATCH_CONFIG_RUNNER
#include <catch2/catch.hpp>
#endif

#include <oneapi/tbb/global_control.h>

int main(int argc, char** argv) {
  // oneTBB starts no more workers than there are cores unless told to; tests with 4 threads mean 4.
  const oneapi::tbb::global_control four_threads(oneapi::tbb::global_control::max_allowed_parallelism, 4);
  return Catch::Session().run(argc, argv);
}

// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#if __has_include(<catch2/catch_session.hpp>)
#include <catch2/catch_session.hpp>
#else
#define CATCH_CONFIG_RUNNER
#include <catch2/catch.hpp>
#endif

#include <oneapi/tbb/global_control.h>

#include <algorithm>
#include <cstdio>
#include <string>

#include "support/run_condition.h"

namespace foothold::test {
namespace {
RunCondition run_condition = nullptr;
}  // namespace

bool set_run_condition(RunCondition condition) {
  run_condition = condition;
  return true;
}

}  // namespace foothold::test

int main(int argc, char** argv) {
  using namespace foothold::test;
  const bool lists_tests = std::any_of(argv + 1, argv + argc, [](const char* argument) {
    const std::string text = argument;
    return text.rfind("--list", 0) == 0 || text == "-l" || text == "-t" || text == "-h" || text == "--help";
  });
  if (run_condition != nullptr && !lists_tests) {
    const std::string obstacle = run_condition();
    if (!obstacle.empty()) {
      std::printf("skipped: %s\n", obstacle.c_str());
      return kSkipped;
    }
  }
  // oneTBB starts no more workers than there are cores unless told to; tests with 4 threads mean 4.
  const oneapi::tbb::global_control four_threads(oneapi::tbb::global_control::max_allowed_parallelism, 4);
  return Catch::Session().run(argc, argv);
}

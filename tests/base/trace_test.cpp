// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "foothold/base/trace.h"

#include <cmath>

#include "support/catch.h"

namespace foothold {
namespace {

TEST_CASE("quantile: interpolates between the ordered values") {
  const std::vector<double> values = {4.0, 1.0, 3.0, 2.0};
  REQUIRE(quantile(values, 0.0) == 1.0);
  REQUIRE(quantile(values, 1.0) == 4.0);
  REQUIRE(quantile(values, 0.5) == 2.5);
  REQUIRE(quantile(values, 0.25) == 1.75);
  REQUIRE(quantile({7.0}, 0.95) == 7.0);
}

TEST_CASE("quantile: of nothing is NaN") { REQUIRE(std::isnan(quantile({}, 0.5))); }

TEST_CASE("Trace: keeps durations by stage in the order measured") {
  Trace trace;
  trace.add("b", 2.0);
  trace.add("a", 1.0);
  trace.add("b", 3.0);
  REQUIRE(trace.stages().size() == 2);
  REQUIRE(trace.stages().at("b") == std::vector<double>{2.0, 3.0});
  trace.clear();
  REQUIRE(trace.stages().empty());
}

TEST_CASE("Stopwatch: never runs backwards") {
  const Stopwatch watch;
  double last = 0.0;
  for (int i = 0; i < 100; ++i) {
    const double now = watch.elapsed_ms();
    REQUIRE(now >= last);
    last = now;
  }
}

}  // namespace
}  // namespace foothold

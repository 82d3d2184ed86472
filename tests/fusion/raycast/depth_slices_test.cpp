// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "raycast/depth_slices.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "foothold/base/random.h"
#include "support/catch.h"
#include "support/random_seed.h"

namespace foothold {
namespace {

TEST_CASE("DepthSlices: no surface is leapt over, and no leap begins before its slice") {
  Random random = test::test_random();
  const auto random_depth = [&] { return 0.05F * std::pow(2.0F, 12.0F * random.uniform()); };  // to 200 m
  for (int round = 0; round < 200; ++round) {
    DepthSlices slices;
    std::vector<std::pair<float, float>> surfaces;
    for (int i = 0; i < round % 8; ++i) {
      const float near_m = random_depth();
      surfaces.emplace_back(near_m, near_m + 0.1F * random.uniform());
      slices.add(surfaces.back().first, surfaces.back().second);
    }
    for (int i = 0; i < 50; ++i) {
      const float from_m = random_depth();
      float expected_m = FLT_MAX;  // the least depth from there on that some surface has
      for (const auto& [near_m, far_m] : surfaces) {
        if (far_m >= from_m) expected_m = std::min(expected_m, std::max(from_m, near_m));
      }
      const float next_m = slices.next(from_m);
      REQUIRE(next_m >= from_m);
      REQUIRE(next_m <= expected_m);
      const bool between = from_m > 0.27F && expected_m < 60.0F;  // where slices are short
      const bool in_slice_of_another = std::any_of(
          surfaces.begin(), surfaces.end(), [&](const auto& surface) { return surface.second < from_m && surface.second > 0.9F * from_m; });
      if (between && !in_slice_of_another) REQUIRE(next_m > expected_m / 1.07F - 1e-6F);
    }
  }
}

TEST_CASE("DepthSlices: without surfaces there is nowhere to go") {
  const DepthSlices slices;
  REQUIRE(slices.next(0.0F) == FLT_MAX);
  REQUIRE(slices.next(1000.0F) == FLT_MAX);
}

}  // namespace
}  // namespace foothold

// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "raycast/surface_regions.h"

#include <vector>

#include "foothold/base/random.h"
#include "support/catch.h"
#include "support/random_seed.h"

namespace foothold {
namespace {

bool has_surface(const SurfaceRegions& regions, const BlockCoordinates& block) {
  return (regions.blocks_with_surface(SurfaceRegions::region_of(block)) & SurfaceRegions::bit_of(block)) != 0;
}

TEST_CASE("SurfaceRegions: tell blocks of a region apart, on both sides of the origin") {
  std::vector<std::uint64_t> slots(1024, 0);
  const SurfaceRegions regions{slots.data(), 10};
  regions.add({-1, 2, 3});
  CHECK(has_surface(regions, {-1, 2, 3}));
  int num_with_surface = 0;
  for (int x = -4; x < 0; ++x) {
    for (int y = 0; y < 4; ++y) {
      for (int z = 0; z < 4; ++z) num_with_surface += has_surface(regions, {x, y, z}) ? 1 : 0;
    }
  }
  CHECK(num_with_surface == 1);
}

TEST_CASE("SurfaceRegions: no block that has surface is hidden, however many regions share a slot") {
  Random random = test::test_random();
  std::vector<std::uint64_t> slots(2, 0);
  const SurfaceRegions regions{slots.data(), 1};
  std::vector<BlockCoordinates> blocks;
  for (int i = 0; i < 60; ++i) {
    const auto coordinate = [&] { return static_cast<int>(random.below(2000)) - 1000; };
    blocks.push_back({coordinate(), coordinate(), coordinate()});
    regions.add(blocks.back());
  }
  for (const BlockCoordinates& block : blocks) REQUIRE(has_surface(regions, block));
}

}  // namespace
}  // namespace foothold

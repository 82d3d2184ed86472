// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// Which leaves a frame clusters anew.
#include <vector>

#include "relocalisation/clouds.h"
#include "support/catch.h"
#include "support/random_seed.h"

namespace foothold {
namespace {

using test::blobs;
using test::Cloud;
using test::Leaves;

/// Which leaves have modes.
std::vector<bool> renewed(Leaves& leaves) {
  std::vector<bool> result;
  for (int leaf = 0; leaf < leaves.reservoirs.view().num_leaves; ++leaf) result.push_back(leaves.modes.view().num_modes[leaf] > 0);
  return result;
}

TEST_CASE("LeafModes::update: round robin visits the leaves in turn") {
  Random random = test::test_random();
  std::vector<Cloud> clouds;
  for (int i = 0; i < 7; ++i) clouds.push_back(blobs(random, 1, 20));
  ClusteringSettings settings;
  settings.touched_first = false;
  settings.leaves_per_frame = 3;
  Leaves leaves(clouds, settings);
  leaves.update();
  REQUIRE(renewed(leaves) == std::vector<bool>{true, true, true, false, false, false, false});
  leaves.update();
  REQUIRE(renewed(leaves) == std::vector<bool>{true, true, true, true, true, true, false});
  leaves.update();
  REQUIRE(renewed(leaves) == std::vector<bool>(7, true));
}

TEST_CASE("LeafModes::update: touched first renews the leaves that changed most") {
  Random random = test::test_random();
  std::vector<Cloud> clouds;
  for (const int size : {20, 50, 0, 40, 10, 30, 7}) clouds.push_back(size == 0 ? Cloud{} : blobs(random, 1, size));
  ClusteringSettings settings;
  settings.leaves_per_frame = 2;
  Leaves leaves(clouds, settings);
  leaves.update();
  REQUIRE(renewed(leaves) == std::vector<bool>{false, true, false, true, false, false, false});
  REQUIRE(leaves.reservoirs.view().num_changed[1] == 0);
  REQUIRE(leaves.reservoirs.view().num_changed[5] == 30);
  leaves.update();
  REQUIRE(renewed(leaves) == std::vector<bool>{true, true, false, true, false, true, false});
  leaves.update();
  REQUIRE(renewed(leaves) == std::vector<bool>{true, true, false, true, true, true, false});
}

TEST_CASE("LeafModes::update: no leaf is begun beyond the point budget") {
  Random random = test::test_random();
  std::vector<Cloud> clouds;
  for (int i = 0; i < 5; ++i) clouds.push_back(blobs(random, 1, 50 - 5 * i));
  ClusteringSettings settings;
  settings.point_budget = 51;  // the first leaf leaves 1 point, which the second overdraws
  Leaves leaves(clouds, settings);
  leaves.update();
  REQUIRE(renewed(leaves) == std::vector<bool>{true, true, false, false, false});
  leaves.update();
  REQUIRE(renewed(leaves) == std::vector<bool>{true, true, true, true, false});
}

}  // namespace
}  // namespace foothold

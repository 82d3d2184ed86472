// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// A forest relocaliser whose saved scene takes a few kB.
#pragma once

#include "foothold/relocalisation/forest_relocaliser.h"
#include "small_world.h"

namespace foothold::fuzz {

inline Forest small_forest() {
  RandomForestSettings settings;
  settings.num_trees = 2;
  settings.depth = 3;
  settings.num_features = 8;
  return make_random_forest(settings);
}

inline ForestRelocaliserSettings small_forest_settings() {
  ForestRelocaliserSettings settings;
  settings.reservoirs.capacity = 16;
  settings.clustering.min_cluster_size = 2;
  settings.clustering.max_modes = 2;
  settings.pose.pool_size = 500;
  settings.pose.num_hypotheses = 16;
  settings.pose.num_candidates = 1;
  settings.num_rolls = 1;
  return settings;
}

}  // namespace foothold::fuzz

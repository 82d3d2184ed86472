// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// A training of a forest that takes no time.
#pragma once

#include "forest_example_collector.h"
#include "forest_grower.h"
#include "small_world.h"

namespace foothold::fuzz {

/// Names the training in its checkpoints.
inline constexpr std::uint64_t kTrainingName = 17;

inline ForestTrainingSettings small_training_settings() {
  ForestTrainingSettings settings;
  settings.num_trees = 2;
  settings.depth = 3;
  settings.num_features = 4;
  settings.num_candidates = 8;
  settings.agreement_weight = 1.0F;
  return settings;
}

inline ForestExamples no_examples() {
  ForestExamples examples;
  examples.num_features = static_cast<std::size_t>(small_training_settings().num_features);
  examples.paired = true;
  return examples;
}

}  // namespace foothold::fuzz

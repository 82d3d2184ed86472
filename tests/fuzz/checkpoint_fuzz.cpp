// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// Checkpoints of a training: what is accepted goes on to a forest, as long as its levels fit.
#include "checked_file.h"
#include "forest_checkpoint.h"
#include "memory_file.h"
#include "small_training.h"

FOOTHOLD_FUZZ_TARGET(checkpoint) {
  using namespace foothold;
  const fuzz::MemoryFile file(fuzz::mended(fuzz::text_of(data, size), fuzz::Chain::kOfPrevious));
  fuzz::attempt([&] {
    ForestExamples examples = fuzz::no_examples();
    std::vector<ForestLevel> levels;
    ForestCheckpoint checkpoint = ForestCheckpoint::resume(file.path(), fuzz::kTrainingName, examples, levels);
    fuzz::require(examples.values.size() == examples.size() * examples.row_size());
    fuzz::require(examples.scene_begins.empty() || examples.scene_begins.back() == examples.size());
    if (examples.size() == 0) return;
    const ForestTrainingSettings settings = fuzz::small_training_settings();
    ForestGrower grower(fuzz::one_thread(), examples, settings);
    for (const ForestLevel& level : levels) {
      if (!grower.apply(level)) return;
    }
    while (!grower.is_complete()) {
      const ForestLevel level = grower.decide();
      checkpoint.add_level(level);
      fuzz::require(grower.apply(level));
    }
    grower.forest(draw_training_features(settings), "fuzzed");
  });
  return 0;
}

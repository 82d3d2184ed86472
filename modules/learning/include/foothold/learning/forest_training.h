// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// Offline training of a forest's branches from recordings with known poses. Reference: [Cavallari2017] Sec. 2.2.1.
///
/// Nobody has to train: default_forest() adapts to any scene. This made it, and is for those who want to know whether branches trained on
/// their own data do better.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "foothold/api/frame_source.h"
#include "foothold/base/context.h"
#include "foothold/base/settings.h"
#include "foothold/relocalisation/forest.h"

namespace foothold {

/// How a forest is trained. (P) the paper's value, (T) tuned here; docs/experiments/forests.md holds the measurements.
struct ForestTrainingSettings {
  int num_trees = 5;                       ///< (P)
  int depth = 15;                          ///< (P)
  int num_features = 256;                  ///< (P)
  float depth_fraction = 0.5F;             ///< (P) 128 of 256
  float min_offset_px_m = 2.0F;            ///< (T)
  float max_offset_px_m = 65.0F;           ///< (T)
  int downscale = 4;                       ///< (T) as FeatureSettings::downscale: a forest is used the way it was trained
  int num_candidates = 512;                ///< (P)
  int examples_per_frame = 300;            ///< (T)
  float tree_fraction = 0.5F;              ///< (P) "a random subset"; its size is ours
  int min_leaf_examples = 1;               ///< (P) none
  float min_child_fraction = 0.0F;         ///< (P) none
  float variance_weight = 1.0F;            ///< (P)
  float agreement_weight = 0.0F;           ///< (P) none
  float covariance_floor_m = 0.01F;        ///< keeps the determinant of flat sets finite
  float covariance_prior_examples = 0.0F;  ///< (P) none
  int frame_stride = 1;                    ///< every so-many-th frame is used
  int rolled_copies = 0;                   ///< (P) none
  float max_roll_deg = 180.0F;             ///< rolled copies are turned by up to so much either way [deg]
  float memory_limit_gb = 4.0F;            ///< memory that training may use [GB]
  std::uint64_t seed = 42;                 ///< of every random choice

  /// Shows each field to the visitor, with its name, what it means and its range.
  template <class Visitor>
  static void fields(Visitor& v) {
    using S = ForestTrainingSettings;
    v(&S::num_trees, "num_trees", "Trees.", Range{1, 32});
    v(&S::depth, "depth", "Splits from root to leaf at most.", Range{1, 20});
    v(&S::num_features, "num_features", "Features that splits choose from.", Range{2, 4096});
    v(&S::depth_fraction, "depth_fraction", "Share of the features that compare depth; the others compare a colour channel.", Range{0, 1});
    v(&S::min_offset_px_m, "min_offset_px_m", "Smallest feature offset, in pixels of a 585 px camera times metres.", Range{0, 1000});
    v(&S::max_offset_px_m, "max_offset_px_m", "Largest feature offset, in pixels of a 585 px camera times metres.", Range{0, 1000});
    v(&S::downscale, "downscale", "Factor by which frames are averaged down before features are evaluated.", Range{1, 8});
    v(&S::num_candidates, "num_candidates", "Splits (feature, threshold) tried at each node.", Range{1, 65536});
    v(&S::examples_per_frame, "examples_per_frame", "Pixels that a frame contributes; fewer if the memory limit demands it.",
      Range{1, 100000});
    v(&S::tree_fraction, "tree_fraction", "Share of all examples that each tree is trained with.", Range{0.001, 1});
    v(&S::min_leaf_examples, "min_leaf_examples", "Examples that each side of a split keeps at least.", Range{1, 1e6});
    v(&S::min_child_fraction, "min_child_fraction", "Share of a node's examples that each side of a split keeps at least.", Range{0, 0.5});
    v(&S::variance_weight, "variance_weight", "Weight of the reduction in spatial variance.", Range{0, 1000});
    v(&S::agreement_weight, "agreement_weight", "Weight of the information that two views of a point share about the side they take.",
      Range{0, 1000});
    v(&S::covariance_floor_m, "covariance_floor_m", "Standard deviation added to every covariance in all directions.", Range{0.00001, 1});
    v(&S::covariance_prior_examples, "covariance_prior_examples",
      "Examples that the parent's covariance counts for when a side's covariance is estimated.", Range{0, 1000});
    v(&S::frame_stride, "frame_stride", "Use every Nth frame.", Range{1, 1e6});
    v(&S::rolled_copies, "rolled_copies", "Copies of each frame, turned about the optical axis by a random angle.", Range{0, 16});
    v(&S::max_roll_deg, "max_roll_deg", "Largest angle of these copies, either way.", Range{0, 180});
    v(&S::memory_limit_gb, "memory_limit_gb", "Memory that training may use [GB].", Range{0.25, 4096});
    v(&S::seed, "seed", "Seed of every random choice.", Range{0, 1.8446744073709552e19});
  }

  /// @throws InvalidSettings naming the field, its value and what is allowed.
  void validate() const;
};

/// What a training is doing.
struct ForestTrainingProgress {
  /// The parts of a training, in order.
  enum class Stage { kExamples, kGrowing };
  Stage stage = Stage::kExamples;  ///< reading examples, or growing trees
  std::int64_t done = 0;           ///< frames read, or levels grown
  std::int64_t total = 0;          ///< of them
};

/// How a training runs; none of it changes the branches.
struct ForestTrainingRun {
  /// File that remembers what is finished, so that an interrupted training can be resumed; empty for none. It grows to the size of the
  /// examples.
  std::string checkpoint;
  /// Continues the training that the checkpoint file remembers, if there is one; otherwise an old file is replaced.
  bool resume = false;
  /// Lines to add to the forest's provenance, such as "commit = abc".
  std::vector<std::string> notes;
  /// Called now and then; training stops when it returns false.
  std::function<bool(const ForestTrainingProgress&)> progress;
};

/// Trains a forest.
///
/// Each sequence is a scene with a coordinate frame of its own: covariances are pooled over scenes, from differences within each.
///
/// @param context    A CPU context. Receives a message when the memory limit thins the examples out.
/// @param sequences  Recordings with poses; frames without one are left out.
/// @return           The forest, or nothing if run.progress asked to stop.
/// @throws InvalidSettings for settings out of range, no sequence, or a memory limit too small for one example a frame;
///         FileError for frames that cannot be read, recordings without any usable pixel, and a damaged checkpoint or one of another
///         training.
/// @pre No sequence is null.
///
/// Determinism: a function of sequences and settings, whatever the threads and however often it was interrupted.
/// Cost:        O(examples x candidates x depth); about 7 us of CPU time for an example that all of five trees learn from.
std::optional<Forest> train_forest(const Context& context, const std::vector<std::shared_ptr<const Sequence>>& sequences,
                                   const ForestTrainingSettings& settings, const ForestTrainingRun& run = {});

}  // namespace foothold

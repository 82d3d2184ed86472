// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// Grows all trees of a forest together, level by level: every node of a level, and for large nodes every group of candidates, is a task.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "foothold/base/context.h"
#include "foothold/learning/forest_training.h"
#include "forest_examples.h"
#include "forest_split.h"

namespace foothold {

/// What became of a node.
struct NodeDecision {
  ForestSplit split;
  std::uint32_t is_split = 0;  ///< 1, or 0 for a leaf
};
static_assert(sizeof(NodeDecision) == 8, "written to checkpoints");

/// The decisions for the open nodes of a level, in the grower's order.
using ForestLevel = std::vector<NodeDecision>;

class ForestGrower {
 public:
  /// Draws the examples of each tree.
  ForestGrower(const Context& context, const ForestExamples& examples, const ForestTrainingSettings& settings);

  /// Decides about all open nodes. The expensive part.
  ForestLevel decide() const;
  /// Carries out decisions, those just made or those of a checkpoint. @return False if they do not fit the open nodes; nothing is changed
  /// then.
  bool apply(const ForestLevel& level);
  int num_levels() const { return num_levels_; }
  bool is_complete() const { return open_.empty(); }

  /// The forest so far; open nodes are leaves.
  Forest forest(const std::vector<ForestFeature>& features, const std::string& provenance) const;

  /// Memory per example and tree, besides the examples themselves [bytes].
  static constexpr std::size_t kBytesPerExample = sizeof(std::uint32_t) + 1;

 private:
  struct Tree {
    std::vector<std::uint32_t> indices;  // of examples; each node's stand together
    std::vector<std::uint8_t> unparted;  // for each of them, 1 while its partner goes the same way
  };
  struct OpenNode {
    int tree = 0;
    std::size_t begin = 0;  // into the tree's indices
    std::size_t end = 0;
    std::int32_t node = 0;
    std::uint64_t key = 0;
  };

  NodeExamples examples_of(const OpenNode& open) const;
  std::size_t partition(const OpenNode& open, const ForestSplit& split);

  const Context& context_;
  const ForestExamples& examples_;
  const ForestTrainingSettings& settings_;
  std::vector<Tree> trees_;
  std::vector<ForestNode> nodes_;  // the first are the roots; left_child is -1 for leaves and open nodes
  std::vector<OpenNode> open_;
  int num_levels_ = 0;
};

}  // namespace foothold

// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "forest_grower.h"

#include <algorithm>
#include <utility>

#include "foothold/base/exec/cpu_executor.h"
#include "foothold/base/random.h"

namespace foothold {
namespace {

enum : std::uint64_t { kSubsetStream = 300 };

constexpr std::size_t kLargeNode = 4096;  // examples from which a node's candidates are shared out among threads

struct NoScratch {};

/// One task: a range of candidates of one node.
struct Search {
  std::size_t node = 0;
  int first = 0;
  int num = 0;
};

}  // namespace

ForestGrower::ForestGrower(const Context& context, const ForestExamples& examples, const ForestTrainingSettings& settings)
    : context_(context), examples_(examples), settings_(settings) {
  for (int t = 0; t < settings.num_trees; ++t) {
    Tree tree;
    Random random(derive_seed(settings.seed, kSubsetStream), static_cast<std::uint64_t>(t));
    tree.indices.reserve(static_cast<std::size_t>(settings.tree_fraction * static_cast<float>(examples.size())) + 1024);
    for (std::size_t i = 0; i < examples.size(); ++i) {
      if (random.uniform() < settings.tree_fraction) tree.indices.push_back(static_cast<std::uint32_t>(i));
    }
    if (examples.paired) tree.unparted.assign(tree.indices.size(), 1);
    nodes_.push_back({-1, 0, 0});
    if (!tree.indices.empty()) open_.push_back({t, 0, tree.indices.size(), t, derive_seed(static_cast<std::uint64_t>(t), 1)});
    trees_.push_back(std::move(tree));
  }
}

NodeExamples ForestGrower::examples_of(const OpenNode& open) const {
  const Tree& tree = trees_[static_cast<std::size_t>(open.tree)];
  const Span<const std::uint32_t> indices(tree.indices.data() + open.begin, open.end - open.begin);
  Span<const std::uint8_t> unparted;
  if (examples_.paired) unparted = {tree.unparted.data() + open.begin, open.end - open.begin};
  return {examples_, indices, unparted, open.key};
}

ForestLevel ForestGrower::decide() const {
  ForestLevel level(open_.size());
  std::vector<Search> searches;
  for (std::size_t i = 0; i < open_.size(); ++i) {
    const std::size_t num_examples = open_[i].end - open_[i].begin;
    if (num_examples < 2 * static_cast<std::size_t>(settings_.min_leaf_examples)) continue;
    const int step = num_examples < kLargeNode ? settings_.num_candidates : kSplitGroup;
    for (int first = 0; first < settings_.num_candidates; first += step) {
      searches.push_back({i, first, std::min(step, settings_.num_candidates - first)});
    }
  }
  std::vector<ScoredSplit> found(searches.size());
  CpuExecutor(context_).for_each_team<NoScratch>(searches.size(), [&](CpuTeam, NoScratch&, std::size_t s) {
    const Search& search = searches[s];
    const NodeExamples node = examples_of(open_[search.node]);
    const NodeVariance variance = node_variance(node, settings_);
    for (int c = 0; c < search.num; c += kSplitGroup) {
      const ScoredSplit split = best_split(node, variance, settings_, search.first + c, std::min(kSplitGroup, search.num - c));
      if (split.score > found[s].score) found[s] = split;
    }
  });
  std::vector<double> best(open_.size(), 0.0);
  for (std::size_t s = 0; s < searches.size(); ++s) {
    const std::size_t node = searches[s].node;
    if (found[s].score > best[node]) {
      best[node] = found[s].score;
      level[node] = {found[s].split, 1};
    }
  }
  return level;
}

bool ForestGrower::apply(const ForestLevel& level) {
  if (level.size() != open_.size()) return false;
  for (const NodeDecision& decision : level) {
    if (decision.is_split != 0 && decision.split.feature >= examples_.num_features) return false;
  }
  std::vector<std::size_t> middles(open_.size());
  CpuExecutor(context_).for_each_team<NoScratch>(open_.size(), [&](CpuTeam, NoScratch&, std::size_t i) {
    middles[i] = level[i].is_split != 0 ? partition(open_[i], level[i].split) : open_[i].end;
  });
  ++num_levels_;
  std::vector<OpenNode> next;
  for (std::size_t i = 0; i < open_.size(); ++i) {
    if (level[i].is_split == 0) continue;
    const OpenNode& parent = open_[i];
    const auto left = static_cast<std::int32_t>(nodes_.size());
    nodes_[static_cast<std::size_t>(parent.node)] = {left, level[i].split.feature, level[i].split.threshold};
    nodes_.push_back({-1, 0, 0});
    nodes_.push_back({-1, 0, 0});
    if (num_levels_ == settings_.depth) continue;
    next.push_back({parent.tree, parent.begin, middles[i], left, derive_seed(parent.key, 0)});
    next.push_back({parent.tree, middles[i], parent.end, left + 1, derive_seed(parent.key, 1)});
  }
  open_ = std::move(next);
  return true;
}

/// Moves a node's examples so that those of the left child come first, in their old order. @return Where the right child's begin.
std::size_t ForestGrower::partition(const OpenNode& open, const ForestSplit& split) {
  Tree& tree = trees_[static_cast<std::size_t>(open.tree)];
  std::vector<std::uint32_t> right;
  std::vector<std::uint8_t> right_unparted;
  std::size_t left = open.begin;
  for (std::size_t i = open.begin; i < open.end; ++i) {
    const std::uint32_t example = tree.indices[i];
    const bool goes_right = examples_.row(example)[split.feature] >= split.threshold;
    std::uint8_t unparted = 0;
    if (examples_.paired) {
      const bool partner_right = examples_.partner_row(example)[split.feature] >= split.threshold;
      unparted = tree.unparted[i] != 0 && partner_right == goes_right ? 1 : 0;
    }
    if (goes_right) {
      right.push_back(example);
      right_unparted.push_back(unparted);
    } else {
      tree.indices[left] = example;
      if (examples_.paired) tree.unparted[left] = unparted;
      ++left;
    }
  }
  std::copy(right.begin(), right.end(), tree.indices.begin() + static_cast<std::ptrdiff_t>(left));
  if (examples_.paired) std::copy(right_unparted.begin(), right_unparted.end(), tree.unparted.begin() + static_cast<std::ptrdiff_t>(left));
  return left;
}

Forest ForestGrower::forest(const std::vector<ForestFeature>& features, const std::string& provenance) const {
  std::vector<ForestNode> nodes;  // tree by tree, each breadth first
  std::vector<std::int32_t> roots;
  std::int32_t num_leaves = 0;
  for (int t = 0; t < settings_.num_trees; ++t) {
    roots.push_back(static_cast<std::int32_t>(nodes.size()));
    std::vector<std::int32_t> queue{t};
    const auto base = static_cast<std::int32_t>(nodes.size());
    for (std::size_t i = 0; i < queue.size(); ++i) {
      ForestNode node = nodes_[static_cast<std::size_t>(queue[i])];
      if (node.left_child < 0) {
        node = {~num_leaves++, 0, 0};
      } else {
        queue.push_back(node.left_child);
        queue.push_back(node.left_child + 1);
        node.left_child = base + static_cast<std::int32_t>(queue.size()) - 2;
      }
      nodes.push_back(node);
    }
  }
  return Forest(features, std::move(nodes), std::move(roots), provenance);
}

}  // namespace foothold

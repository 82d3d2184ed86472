// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "foothold/relocalisation/forest.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "foothold/base/checksum.h"
#include "foothold/base/error.h"

namespace foothold {
namespace {

constexpr float kMaxOffsetPxM = 1e4F;  ///< far beyond any image, and small enough for the partner's pixel to be an int

[[noreturn]] void reject(const std::string& what) { throw InvalidSettings("forest: " + what); }

/// Throws unless min <= count <= max.
void check_count(const char* what, std::size_t count, std::size_t min, int max) {
  if (count < min) reject(std::string("has no ") + what);
  if (count > static_cast<std::size_t>(max)) {
    reject("has " + std::to_string(count) + " " + what + ", expected at most " + std::to_string(max));
  }
}

void check_features(const std::vector<ForestFeature>& features) {
  check_count("features", features.size(), 0, kMaxForestFeatures);
  for (const ForestFeature& feature : features) {
    const auto channel = static_cast<std::int32_t>(feature.channel);
    if (channel < 0 || channel > 3) reject("feature channel is " + std::to_string(channel) + ", expected 0 to 3");
    for (const float offset : {feature.offset_u_px_m, feature.offset_v_px_m}) {
      if (!(std::abs(offset) <= kMaxOffsetPxM))
        reject("feature offset is " + detail::to_text(offset) + ", expected at most " + detail::to_text(kMaxOffsetPxM));
    }
  }
}

/// Walks from the roots to the leaves, and checks every step.
class TreeWalk {
 public:
  TreeWalk(const std::vector<ForestNode>& nodes, std::size_t num_features)
      : nodes_(nodes), num_features_(num_features), reached_(nodes.size(), false), leaf_seen_(nodes.size(), false) {}

  void run(const std::vector<std::int32_t>& roots) {
    for (const std::int32_t root : roots) visit(root, 0);
    while (!open_.empty()) {
      const auto [index, depth] = open_.back();
      open_.pop_back();
      enter(index, depth);
    }
    if (num_reached_ != nodes_.size()) {
      reject("has " + std::to_string(nodes_.size()) + " nodes, of which only " + std::to_string(num_reached_) + " belong to a tree");
    }
    const auto gap = std::find(leaf_seen_.begin(), leaf_seen_.begin() + num_leaves_, false) - leaf_seen_.begin();
    if (gap != num_leaves_) reject("has " + std::to_string(num_leaves_) + " leaves, but none of number " + std::to_string(gap));
  }

  int num_leaves() const { return num_leaves_; }
  int depth() const { return depth_; }

 private:
  void visit(std::int64_t node, int depth) {
    const auto num_nodes = static_cast<std::int64_t>(nodes_.size());
    if (node < 0 || node >= num_nodes) reject("node " + std::to_string(node) + " is out of range, there are " + std::to_string(num_nodes));
    if (reached_[static_cast<std::size_t>(node)]) reject("node " + std::to_string(node) + " has two parents");
    if (depth > kMaxForestDepth) reject("is deeper than " + std::to_string(kMaxForestDepth) + " splits");
    reached_[static_cast<std::size_t>(node)] = true;
    ++num_reached_;
    open_.emplace_back(node, depth);
  }

  void enter(std::int64_t index, int depth) {
    const ForestNode& node = nodes_[static_cast<std::size_t>(index)];
    if (node.left_child >= 0) {
      if (node.feature >= num_features_)
        reject("node " + std::to_string(index) + " uses feature " + std::to_string(node.feature) + ", there are " +
               std::to_string(num_features_));
      visit(node.left_child, depth + 1);
      visit(std::int64_t{node.left_child} + 1, depth + 1);
      return;
    }
    const auto leaf = static_cast<std::size_t>(~node.left_child);
    if (leaf >= nodes_.size() || leaf_seen_[leaf]) reject("leaf " + std::to_string(leaf) + " is out of range or appears twice");
    leaf_seen_[leaf] = true;
    ++num_leaves_;
    depth_ = std::max(depth_, depth);
  }

  const std::vector<ForestNode>& nodes_;
  std::size_t num_features_;
  std::vector<bool> reached_;
  std::vector<bool> leaf_seen_;
  std::vector<std::pair<std::int64_t, int>> open_;  ///< node, depth
  std::size_t num_reached_ = 0;
  int num_leaves_ = 0;
  int depth_ = 0;
};

}  // namespace

Forest::Forest(std::vector<ForestFeature> features, std::vector<ForestNode> nodes, std::vector<std::int32_t> roots, std::string provenance)
    : features_(std::move(features)), nodes_(std::move(nodes)), roots_(std::move(roots)), provenance_(std::move(provenance)) {
  check_count("trees", roots_.size(), 1, kMaxForestTrees);
  check_count("nodes", nodes_.size(), 1, 2 * kMaxForestLeaves);
  check_features(features_);
  check_count("bytes of provenance", provenance_.size(), 0, kMaxForestProvenanceBytes);
  TreeWalk walk(nodes_, features_.size());
  walk.run(roots_);
  check_count("leaves", static_cast<std::size_t>(walk.num_leaves()), 1, kMaxForestLeaves);
  num_leaves_ = walk.num_leaves();
  depth_ = walk.depth();
}

std::uint64_t Forest::fingerprint() const {
  std::uint64_t hash = fnv1a(kFnvBasis, features_.data(), features_.size() * sizeof(ForestFeature));
  hash = fnv1a(hash, nodes_.data(), nodes_.size() * sizeof(ForestNode));
  return fnv1a(hash, roots_.data(), roots_.size() * sizeof(std::int32_t));
}

ForestView Forest::view() const { return {features_.data(), nodes_.data(), roots_.data(), num_trees(), num_leaves_}; }

}  // namespace foothold

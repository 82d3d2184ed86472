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

}  // namespace

Forest::Forest(std::vector<ForestFeature> features, std::vector<ForestNode> nodes, std::vector<std::int32_t> roots, std::string provenance)
    : features_(std::move(features)), nodes_(std::move(nodes)), roots_(std::move(roots)), provenance_(std::move(provenance)) {
  if (roots_.empty()) reject("has no trees");
  const auto num_nodes = static_cast<std::int64_t>(nodes_.size());
  for (const ForestFeature& feature : features_) {
    const auto channel = static_cast<std::int32_t>(feature.channel);
    if (channel < 0 || channel > 3) reject("feature channel is " + std::to_string(channel) + ", expected 0 to 3");
    for (const float offset : {feature.offset_u_px_m, feature.offset_v_px_m}) {
      if (!(std::abs(offset) <= kMaxOffsetPxM))
        reject("feature offset is " + std::to_string(offset) + ", expected at most " + std::to_string(kMaxOffsetPxM));
    }
  }
  std::vector<bool> reached(nodes_.size(), false);
  std::vector<bool> leaf_seen(nodes_.size(), false);
  std::vector<std::pair<std::int64_t, int>> open;  // node, depth
  const auto visit = [&](std::int64_t node, int depth) {
    if (node < 0 || node >= num_nodes) reject("node " + std::to_string(node) + " is out of range, there are " + std::to_string(num_nodes));
    if (reached[static_cast<std::size_t>(node)]) reject("node " + std::to_string(node) + " has two parents");
    reached[static_cast<std::size_t>(node)] = true;
    open.emplace_back(node, depth);
  };
  for (const std::int32_t root : roots_) visit(root, 0);
  while (!open.empty()) {
    const auto [index, depth] = open.back();
    open.pop_back();
    const ForestNode& node = nodes_[static_cast<std::size_t>(index)];
    if (node.left_child >= 0) {
      if (node.feature >= features_.size())
        reject("node " + std::to_string(index) + " uses feature " + std::to_string(node.feature) + ", there are " +
               std::to_string(features_.size()));
      visit(node.left_child, depth + 1);
      visit(std::int64_t{node.left_child} + 1, depth + 1);
    } else {
      const auto leaf = static_cast<std::size_t>(~node.left_child);
      if (leaf >= nodes_.size() || leaf_seen[leaf]) reject("leaf " + std::to_string(leaf) + " is out of range or appears twice");
      leaf_seen[leaf] = true;
      num_leaves_ = std::max(num_leaves_, static_cast<int>(leaf) + 1);
      depth_ = std::max(depth_, depth);
    }
  }
}

std::uint64_t Forest::fingerprint() const {
  std::uint64_t hash = fnv1a(kFnvBasis, features_.data(), features_.size() * sizeof(ForestFeature));
  hash = fnv1a(hash, nodes_.data(), nodes_.size() * sizeof(ForestNode));
  return fnv1a(hash, roots_.data(), roots_.size() * sizeof(std::int32_t));
}

ForestView Forest::view() const { return {features_.data(), nodes_.data(), roots_.data(), num_trees(), num_leaves_}; }

}  // namespace foothold

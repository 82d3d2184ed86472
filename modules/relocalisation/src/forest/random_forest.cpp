// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include <cmath>
#include <sstream>

#include "foothold/base/random.h"
#include "foothold/relocalisation/forest.h"

namespace foothold {
namespace {

enum Stream : std::uint64_t { kFeatureStream, kNodeStream };

ForestFeature random_feature(const RandomForestSettings& settings, int index, Random random) {
  constexpr float kTwoPi = 6.28318530718F;
  const float angle = random.uniform(0.0F, kTwoPi);
  const float radius = random.uniform(settings.min_offset_px_m, settings.max_offset_px_m);
  const bool is_depth = index < settings.num_features / 2;
  const auto channel = is_depth ? FeatureChannel::kDepth : static_cast<FeatureChannel>(1 + random.below(3));
  return {channel, radius * std::cos(angle), radius * std::sin(angle)};
}

/// A draw from the Laplace distribution of the given scale around zero, by inversion.
float laplace(Random& random, float scale) {
  const float u = random.uniform() - 0.5F + 0x1p-25F;  // never zero, so that the logarithm is finite
  return (u < 0.0F ? scale : -scale) * std::log(1.0F - 2.0F * std::abs(u) + 0x1p-24F);
}

ForestNode random_split(const RandomForestSettings& settings, const std::vector<ForestFeature>& features, Random random) {
  ForestNode node;
  node.feature = static_cast<std::uint16_t>(random.below(static_cast<std::uint32_t>(settings.num_features)));
  const bool is_depth = features[node.feature].channel == FeatureChannel::kDepth;
  const float threshold = laplace(random, is_depth ? settings.depth_threshold_mm : settings.colour_threshold);
  node.threshold = static_cast<std::int16_t>(std::lround(std::fmin(std::fmax(threshold, -32000.0F), 32000.0F)));
  return node;
}

std::string provenance_of(const RandomForestSettings& settings) {
  std::ostringstream text;
  text << "data-free forest of random splits";
  for (const SettingDescription& setting : describe_settings(settings)) text << "\n" << setting.path << " = " << setting.value;
  return text.str();
}

}  // namespace

Forest make_random_forest(const RandomForestSettings& settings) {
  validate_settings(settings);
  if (settings.max_offset_px_m < settings.min_offset_px_m) {
    throw InvalidSettings("setting max_offset_px_m: got " + detail::to_text(settings.max_offset_px_m) +
                          ", expected at least min_offset_px_m = " + detail::to_text(settings.min_offset_px_m));
  }
  const std::int64_t num_leaves = std::int64_t{settings.num_trees} << settings.depth;
  if (num_leaves > kMaxForestLeaves) {
    throw InvalidSettings("settings num_trees and depth: got " + std::to_string(settings.num_trees) + " trees of depth " +
                          std::to_string(settings.depth) + ", which have " + std::to_string(num_leaves) + " leaves, expected at most " +
                          std::to_string(kMaxForestLeaves));
  }
  std::vector<ForestFeature> features;
  for (int i = 0; i < settings.num_features; ++i) {
    features.push_back(random_feature(settings, i, Random(derive_seed(settings.seed, kFeatureStream), static_cast<std::uint64_t>(i))));
  }
  const int num_splits = (1 << settings.depth) - 1;  // per tree; nodes in breadth-first order, so that node i has children 2i+1 and 2i+2
  const int num_nodes = 2 * num_splits + 1;
  std::vector<ForestNode> nodes;
  nodes.reserve(static_cast<std::size_t>(num_nodes) * static_cast<std::size_t>(settings.num_trees));
  std::vector<std::int32_t> roots;
  for (int tree = 0; tree < settings.num_trees; ++tree) {
    const std::int32_t root = tree * num_nodes;
    roots.push_back(root);
    for (int i = 0; i < num_nodes; ++i) {
      const bool is_leaf = i >= num_splits;
      ForestNode node;
      if (!is_leaf)
        node = random_split(settings, features, Random(derive_seed(settings.seed, kNodeStream), static_cast<std::uint64_t>(root + i)));
      node.left_child = is_leaf ? ~(tree * (num_splits + 1) + i - num_splits) : root + 2 * i + 1;
      nodes.push_back(node);
    }
  }
  return Forest(std::move(features), std::move(nodes), std::move(roots), provenance_of(settings));
}

}  // namespace foothold

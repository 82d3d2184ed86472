// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// The search for the best split of one node. Reference: [Cavallari2017] Sec. 2.2.1; [Valentin2015] for the spatial variance.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "foothold/base/span.h"
#include "foothold/learning/forest_training.h"
#include "forest_examples.h"

namespace foothold {

/// theta = (phi, tau): an example goes right iff its feature is at least the threshold.
struct ForestSplit {
  std::uint16_t feature = 0;
  std::int16_t threshold = 0;
};

/// The examples that reached a node.
struct NodeExamples {
  const ForestExamples& all;
  Span<const std::uint32_t> indices;  ///< rising, so that scenes stand together
  Span<const std::uint8_t> unparted;  ///< for each of them, 1 if its partner reached this node too; empty unless all.paired
  std::uint64_t node_key = 0;         ///< names the node's random choices
};

/// The part of a node's examples that belongs to one scene.
struct SceneSums {
  std::size_t begin = 0;  ///< into the node's indices
  std::size_t end = 0;
  Eigen::Vector3f mean_world = Eigen::Vector3f::Zero();
  double moments[10] = {};  ///< sums over its points, relative to the mean: 1, x, y, z, xx, xy, xz, yy, yz, zz
};

/// The spatial variance of a node before it is split.
struct NodeVariance {
  std::vector<SceneSums> scenes;
  double log_determinant = 0.0;
  double pooled_covariance[6] = {};  ///< xx xy xz yy yz zz [m^2]
};

/// Pools the covariance of a node's points over scenes, from differences to each scene's mean.
NodeVariance node_variance(const NodeExamples& node, const ForestTrainingSettings& settings);

/// A split and what it is worth.
struct ScoredSplit {
  ForestSplit split;
  double score = 0.0;  ///< only splits of positive score are worth making
};

/// The number of candidates that best_split() tries in a single pass over the examples.
inline constexpr int kSplitGroup = 32;

/// Tries the candidates [first, first + num) of a node and returns the best; of equals, the first. The score is 0 if none is allowed.
///
/// @pre num <= kSplitGroup and the node has examples.
/// Determinism: a function of the arguments alone.
ScoredSplit best_split(const NodeExamples& node, const NodeVariance& variance, const ForestTrainingSettings& settings, int first, int num);

}  // namespace foothold

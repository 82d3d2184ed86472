// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// Leaves filled with clouds of points, for tests of clustering.
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <utility>
#include <vector>

#include "clustering/leaf_modes.h"
#include "foothold/base/random.h"

namespace foothold::test {

using Cloud = std::vector<ReservoirPoint>;

/// Reservoirs of one leaf per cloud, and their modes.
struct Leaves {
  Leaves(const std::vector<Cloud>& clouds, const ClusteringSettings& settings, int num_threads = 1)
      : context(options_of(num_threads)),
        reservoirs(context, static_cast<int>(clouds.size()), reservoirs_of(), 42),
        modes(context, static_cast<int>(clouds.size()), settings) {
    TrainingExamples examples(MemoryKind::kHost);
    std::size_t count = 0;
    for (const Cloud& cloud : clouds) count += cloud.size();
    examples.points.resize(count);
    examples.leaves.resize(count);
    std::size_t next = 0;
    for (std::size_t leaf = 0; leaf < clouds.size(); ++leaf) {
      for (const ReservoirPoint& point : clouds[leaf]) {
        examples.points[next] = point;
        examples.leaves[next++] = static_cast<std::uint32_t>(leaf);
      }
    }
    reservoirs.insert(context, examples);
  }

  std::vector<Mode> modes_of(std::size_t leaf) {
    const LeafModesView view = modes.view();
    std::vector<Mode> result;
    for (std::uint32_t k = 0; k < view.num_modes[leaf]; ++k) {
      result.push_back(view.modes.at(static_cast<std::uint32_t>(leaf), static_cast<int>(k)));
    }
    return result;
  }
  void update() { modes.update(context, reservoirs); }

  static ContextOptions options_of(int num_threads) {
    ContextOptions options;
    options.num_threads = num_threads;
    return options;
  }
  static ReservoirSettings reservoirs_of() {
    ReservoirSettings settings;
    settings.capacity = 1024;
    return settings;
  }

  Context context;
  LeafReservoirs reservoirs;
  LeafModes modes;
};

inline ReservoirPoint point_at(const Eigen::Vector3f& p_mm, std::uint16_t rgb565 = 0) {
  return {static_cast<std::int16_t>(std::lround(p_mm.x())), static_cast<std::int16_t>(std::lround(p_mm.y())),
          static_cast<std::int16_t>(std::lround(p_mm.z())), rgb565};
}

inline Eigen::Vector3f random_vector(Random& random, float size) {
  return {random.uniform(-size, size), random.uniform(-size, size), random.uniform(-size, size)};
}

/// Blobs a metre apart, each within 2 cm of its middle, shuffled; no two of a size.
inline Cloud blobs(Random& random, int num_blobs, int smallest) {
  Cloud cloud;
  const Eigen::Vector3f corner = random_vector(random, 8000.0F);
  for (int blob = 0; blob < num_blobs; ++blob) {
    const Eigen::Vector3f middle = corner + 1000.0F * Eigen::Vector3f(static_cast<float>(blob % 3), static_cast<float>(blob / 3), 0.0F);
    for (int i = 0; i < smallest + 3 * blob; ++i) cloud.push_back(point_at(middle + random_vector(random, 20.0F)));
  }
  for (std::size_t i = cloud.size(); i > 1; --i) std::swap(cloud[i - 1], cloud[random.below(static_cast<std::uint32_t>(i))]);
  return cloud;
}

}  // namespace foothold::test

// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "forest/device_forest.h"

#include <cmath>

#include "foothold/base/contract.h"

namespace foothold {
namespace {

/// The angle [rad] of the n-th roll: 0, then one step, one step back, two steps, ...
double roll_angle(int roll, int num_rolls) {
  constexpr double kFullTurn = 6.283185307179586;
  const int steps = (roll + 1) / 2;
  return (roll % 2 == 1 ? steps : -steps) * kFullTurn / num_rolls;
}

std::vector<ForestFeature> turned_features(const std::vector<ForestFeature>& upright, int num_rolls) {
  std::vector<ForestFeature> turned;
  turned.reserve(upright.size() * static_cast<std::size_t>(num_rolls));
  for (int roll = 0; roll < num_rolls; ++roll) {
    const double angle = roll_angle(roll, num_rolls);
    const double c = std::cos(angle);
    const double s = std::sin(angle);
    for (const ForestFeature& feature : upright) {
      const auto u = static_cast<double>(feature.offset_u_px_m);
      const auto v = static_cast<double>(feature.offset_v_px_m);
      turned.push_back({feature.channel, static_cast<float>(c * u - s * v), static_cast<float>(s * u + c * v)});
    }
  }
  return turned;
}

}  // namespace

DeviceForest::DeviceForest(const Memory& memory, const Forest& forest, int num_rolls)
    : features_(memory, Span<const ForestFeature>(turned_features(forest.features(), num_rolls))),
      nodes_(memory, Span<const ForestNode>(forest.nodes())),
      roots_(memory, Span<const std::int32_t>(forest.roots())),
      num_leaves_(forest.num_leaves()),
      num_rolls_(num_rolls) {}

ForestView DeviceForest::view(int roll) const {
  FOOTHOLD_EXPECTS(roll >= 0 && roll < num_rolls_);
  const std::size_t num_features = features_.size() / static_cast<std::size_t>(num_rolls_);
  return {features_.data() + static_cast<std::size_t>(roll) * num_features, nodes_.data(), roots_.data(), static_cast<int>(roots_.size()),
          num_leaves_};
}

}  // namespace foothold

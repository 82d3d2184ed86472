// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// The forest's arrays in the device's memory, with its features turned for rolled cameras.
#pragma once

#include "foothold/base/array.h"
#include "foothold/relocalisation/forest.h"

namespace foothold {

/// A camera that is rolled about its optical axis sees a point as before if features look for their partners in directions that are rolled
/// as far. So a forest finds in rolled views the leaves that it filled in upright ones, once its offsets are turned.
class DeviceForest {
 public:
  /// @param num_rolls  evenly spaced rolls to turn features by.
  DeviceForest(const Memory& memory, const Forest& forest, int num_rolls);

  int num_rolls() const { return num_rolls_; }
  /// The forest for a camera that is rolled: 0 is upright, then the nearest to upright come first, to either side.
  ForestView view(int roll = 0) const;

 private:
  Array<ForestFeature> features_;  ///< roll by roll
  Array<ForestNode> nodes_;
  Array<std::int32_t> roots_;
  int num_leaves_;
  int num_rolls_;
};

}  // namespace foothold

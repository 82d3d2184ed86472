// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// The examples that a forest is trained with.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace foothold {

/// The examples of all scenes, scene by scene. An example is one pixel: the values of all features and the point it sees.
///
/// Where pairs are wanted, a row has a second half: the values at a pixel of another view that sees the same point.
struct ForestExamples {
  std::size_t num_features = 0;
  bool paired = false;
  std::vector<std::int16_t> values;           ///< size() rows of row_size() values, in millimetres or grey levels
  std::vector<Eigen::Vector3f> points_world;  ///< [m], in the frame of the example's scene
  std::vector<std::size_t> scene_begins;      ///< first example of each scene, and at last the number of examples

  std::size_t size() const { return points_world.size(); }
  std::size_t row_size() const { return paired ? 2 * num_features : num_features; }
  const std::int16_t* row(std::size_t example) const { return values.data() + example * row_size(); }
  const std::int16_t* partner_row(std::size_t example) const { return row(example) + num_features; }
};

}  // namespace foothold

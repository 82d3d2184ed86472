// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// A triangle mesh: what fusion extracts and what files hold.
#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "foothold/base/image.h"

namespace foothold {

/// A coloured triangle mesh in the world frame [m]. Normals and colours are per vertex, or empty.
struct Mesh {
  std::vector<Eigen::Vector3f> vertices;
  std::vector<Eigen::Vector3f> normals;  ///< unit length, pointing into free space
  std::vector<Rgb8> colours;
  std::vector<std::array<int, 3>> triangles;  ///< vertex indices, anticlockwise as seen from free space
};

}  // namespace foothold

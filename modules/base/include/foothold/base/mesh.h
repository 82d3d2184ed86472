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
  std::vector<Eigen::Vector3f> vertices;      ///< positions in the world frame [m]
  std::vector<Eigen::Vector3f> normals;       ///< unit length, pointing into free space
  std::vector<Rgb8> colours;                  ///< of the surface at each vertex
  std::vector<std::array<int, 3>> triangles;  ///< vertex indices, anticlockwise as seen from free space
};

}  // namespace foothold

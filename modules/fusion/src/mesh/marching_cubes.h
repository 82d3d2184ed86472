// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// The cases of marching cubes, derived from the topology of the cube.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

namespace foothold {

/// Corner c of a cube lies at (c & 1, c >> 1 & 1, c >> 2). Edge 4 * axis + k runs along the axis from the k-th corner that has a 0 there.
struct CubeEdge {
  int corner = 0;
  int axis = 0;
};
CubeEdge cube_edge(int edge);

/// Triangles by edges of the cube, anticlockwise as seen from the outside corners.
using CubeTriangles = std::vector<std::array<std::int8_t, 3>>;

/// The triangles of each case; bit c of the case is set if corner c is inside.
///
/// On every face the crossed edges are joined so that each cut separates the inside corners: the choice depends on the face alone, so that
/// two cubes agree on the face they share. The cuts form closed loops, and each loop is a fan of triangles.
const std::array<CubeTriangles, 256>& marching_cubes_cases();

}  // namespace foothold

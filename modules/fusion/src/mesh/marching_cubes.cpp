// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "mesh/marching_cubes.h"

namespace foothold {

namespace {

int other_axis(int axis, int which) { return (axis + which) % 3; }

/// The edge between two corners that differ in one bit.
int edge_between(int a, int b) {
  const int corner = a & b;
  const int axis = (a ^ b) == 1 ? 0 : (a ^ b) == 2 ? 1 : 2;
  // The rank of the corner among those without the axis' bit: the two other bits, in order.
  const int low_bits = corner & ((1 << axis) - 1);
  const int high_bits = (corner >> (axis + 1)) << axis;
  return 4 * axis + (high_bits | low_bits);
}

/// The corners of a face, anticlockwise as seen from outside the cube.
std::array<int, 4> face_corners(int axis, int side) {
  const int u = 1 << other_axis(axis, 1);
  const int v = 1 << other_axis(axis, 2);
  const int base = side << axis;
  if (side == 1) return {base, base | u, base | u | v, base | v};
  return {base, base | v, base | u | v, base | u};
}

/// For each crossed edge of the cube, the edge that follows it on the cut of the one face that it enters the inside on; -1 elsewhere.
std::array<int, 12> link_cuts(int inside) {
  std::array<int, 12> next{};
  next.fill(-1);
  const auto is_inside = [&](int corner) { return (inside >> corner & 1) != 0; };
  for (int face = 0; face < 6; ++face) {
    const std::array<int, 4> corners = face_corners(face % 3, face / 3);
    for (int i = 0; i < 4; ++i) {
      // A run of inside corners, going round: it begins after corner i and is cut off by one segment.
      const int before = corners[static_cast<std::size_t>(i)];
      int k = (i + 1) % 4;
      if (is_inside(before) || !is_inside(corners[static_cast<std::size_t>(k)])) continue;
      const int entry = edge_between(before, corners[static_cast<std::size_t>(k)]);
      while (is_inside(corners[static_cast<std::size_t>((k + 1) % 4)])) k = (k + 1) % 4;
      const int exit = edge_between(corners[static_cast<std::size_t>(k)], corners[static_cast<std::size_t>((k + 1) % 4)]);
      next[static_cast<std::size_t>(entry)] = exit;
    }
  }
  return next;
}

CubeTriangles triangulate(int inside) {
  const std::array<int, 12> next = link_cuts(inside);
  std::array<bool, 12> done{};
  CubeTriangles triangles;
  for (int first = 0; first < 12; ++first) {
    if (next[static_cast<std::size_t>(first)] < 0 || done[static_cast<std::size_t>(first)]) continue;
    std::vector<int> loop;
    for (int edge = first; !done[static_cast<std::size_t>(edge)]; edge = next[static_cast<std::size_t>(edge)]) {
      done[static_cast<std::size_t>(edge)] = true;
      loop.push_back(edge);
    }
    for (std::size_t i = 2; i < loop.size(); ++i) {
      triangles.push_back({static_cast<std::int8_t>(loop[0]), static_cast<std::int8_t>(loop[i - 1]), static_cast<std::int8_t>(loop[i])});
    }
  }
  return triangles;
}

std::array<CubeTriangles, 256> derive_cases() {
  std::array<CubeTriangles, 256> cases;
  for (int inside = 0; inside < 256; ++inside) cases[static_cast<std::size_t>(inside)] = triangulate(inside);
  return cases;
}

}  // namespace

CubeEdge cube_edge(int edge) {
  const int axis = edge / 4;
  const int rank = edge % 4;
  const int low_bits = rank & ((1 << axis) - 1);
  const int high_bits = rank >> axis;
  return {(high_bits << (axis + 1)) | low_bits, axis};
}

const std::array<CubeTriangles, 256>& marching_cubes_cases() {
  static const std::array<CubeTriangles, 256> cases = derive_cases();
  return cases;
}

}  // namespace foothold

// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// How far one surface lies from another.
#pragma once

#include "foothold/base/mesh.h"

namespace foothold {

/// Distances from the vertices of one mesh to the surface of another. Vertices farther than the limit have no counterpart there.
struct MeshDistance {
  int num_vertices = 0;   ///< of the first mesh
  int num_near = 0;       ///< with a counterpart; the distances below are of these
  int num_within = 0;     ///< within the tolerance
  double mean_m = 0.0;    ///< NaN without near vertices, as are those below
  double rmse_m = 0.0;    ///< root of the mean square [m]
  double median_m = 0.0;  ///< the median [m]
  double p95_m = 0.0;     ///< the 95th percentile [m]
};

/// Measures the distance of each vertex of `measured` to the nearest point of the triangles of `reference`.
///
/// @param tolerance_m  Counted in num_within, such as the size of a voxel.
/// @param limit_m      The farthest distance that is looked for; positive, at least the tolerance. Cost grows with its square.
MeshDistance mesh_distance(const Mesh& measured, const Mesh& reference, double tolerance_m, double limit_m = 0.05);

}  // namespace foothold

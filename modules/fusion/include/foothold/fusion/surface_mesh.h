// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// Turns the map into triangles.
#pragma once

#include "foothold/base/mesh.h"
#include "foothold/fusion/tsdf_volume.h"

namespace foothold {

/// Extracts the surface, where the signed distance is zero, by marching cubes over all blocks.
///
/// Cells with a voxel that fewer than `min_weight` frames observed are left out: there the mesh has a border. Elsewhere it is watertight,
/// also across blocks: vertices are shared, and ambiguous faces are cut alike from both sides.
///
/// @param volume      Maps in device memory are copied to the host first.
/// @param min_weight  [1, 255]
/// @return Vertices with normals (of the adjacent triangles, by area) and colours, in block order. Empty for an empty map.
///
/// Determinism: a function of the map. Cost: O(blocks), one thread. Reference: [Lorensen1987].
Mesh extract_mesh(const TsdfVolume& volume, int min_weight = 1);

}  // namespace foothold

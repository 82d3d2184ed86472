// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// Meshes in PLY files, binary and little-endian: what MeshLab, Blender and CloudCompare open.
#pragma once

#include <string>

#include "foothold/base/mesh.h"

namespace foothold {

/// Writes a mesh; normals and colours where it has them. Replaces the file only when complete.
/// @pre Normals and colours are as many as vertices, or none; triangles name existing vertices. @throws FileError
void write_ply(const std::string& path, const Mesh& mesh);

/// Reads a mesh from a binary little-endian PLY file of float (or double) positions, optional normals and 8-bit colours, and triangles.
/// Other properties are skipped.
/// @throws FileError for another format, a file cut short, a face that is no triangle, or one that names a missing vertex.
Mesh read_ply(const std::string& path);

}  // namespace foothold

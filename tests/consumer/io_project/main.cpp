// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// Writes a mesh, reads it again, and opens a rendered room: what module io links is there.
#include <cstdio>

#include "foothold/io/mesh_file.h"
#include "foothold/io/sequence.h"

int main() {
  foothold::Mesh mesh;
  mesh.vertices = {{0.0F, 0.0F, 0.0F}, {1.0F, 0.0F, 0.0F}, {0.0F, 1.0F, 0.0F}};
  mesh.triangles = {{0, 1, 2}};
  foothold::write_ply("triangle.ply", mesh);
  const std::size_t num_triangles = foothold::read_ply("triangle.ply").triangles.size();
  const int num_frames = foothold::open_sequence("synthetic:kitchen?frames=3", foothold::Context{})->num_frames();
  std::printf("%zu triangle, %d frames\n", num_triangles, num_frames);
  return num_triangles == 1 && num_frames == 3 ? 0 : 1;
}

// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// Meshes: what is accepted may be indexed without further checks.
#include "fuzz.h"
#include "mesh_file.h"

FOOTHOLD_FUZZ_TARGET(ply) {
  using namespace foothold;
  const std::string bytes = fuzz::text_of(data, size);
  fuzz::attempt([&] {
    const Mesh mesh = io::parse_ply(bytes, "mesh.ply");
    fuzz::require(mesh.normals.empty() || mesh.normals.size() == mesh.vertices.size());
    fuzz::require(mesh.colours.empty() || mesh.colours.size() == mesh.vertices.size());
    for (const auto& triangle : mesh.triangles) {
      for (const int corner : triangle) fuzz::require(corner >= 0 && static_cast<std::size_t>(corner) < mesh.vertices.size());
    }
  });
  return 0;
}

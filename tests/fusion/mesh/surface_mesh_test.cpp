// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "foothold/fusion/surface_mesh.h"

#include <map>

#include "foothold/synthetic/synthetic_sequence.h"
#include "fusion/scene.h"
#include "mesh/marching_cubes.h"
#include "support/catch.h"

namespace foothold {
namespace {

using test::Scene;

/// How often each directed edge occurs.
std::map<std::pair<int, int>, int> directed_edges(const Mesh& mesh) {
  std::map<std::pair<int, int>, int> edges;
  for (const std::array<int, 3>& t : mesh.triangles) {
    for (std::size_t i = 0; i < 3; ++i) ++edges[{t[i], t[(i + 1) % 3]}];
  }
  return edges;
}

TEST_CASE("marching_cubes_cases: every case is made of closed cuts around its inside corners") {
  const auto& cases = marching_cubes_cases();
  for (int inside = 0; inside < 256; ++inside) {
    const CubeTriangles& triangles = cases[static_cast<std::size_t>(inside)];
    std::map<std::pair<int, int>, int> edges;
    std::array<bool, 12> used{};
    for (const auto& t : triangles) {
      for (std::size_t i = 0; i < 3; ++i) {
        used[static_cast<std::size_t>(t[i])] = true;
        ++edges[{t[i], t[(i + 1) % 3]}];
      }
    }
    for (int edge = 0; edge < 12; ++edge) {
      const CubeEdge e = cube_edge(edge);
      const bool crossed = (inside >> e.corner & 1) != (inside >> (e.corner | 1 << e.axis) & 1);
      REQUIRE(used[static_cast<std::size_t>(edge)] == crossed);
    }
    // An edge of a triangle without its opposite lies on a face of the cube: its two ends share a face.
    for (const auto& [edge, count] : edges) {
      REQUIRE(count == 1);
      if (edges.count({edge.second, edge.first}) != 0) continue;
      const CubeEdge a = cube_edge(edge.first);
      const CubeEdge b = cube_edge(edge.second);
      bool share_face = false;
      for (int axis = 0; axis < 3; ++axis) {
        share_face |= axis != a.axis && axis != b.axis && (a.corner >> axis & 1) == (b.corner >> axis & 1);
      }
      REQUIRE(share_face);
    }
  }
  REQUIRE(cases[0].empty());
  REQUIRE(cases[255].empty());
  REQUIRE(cases[1].size() == 1);
  REQUIRE(cases[0x0F].size() == 2);
}

TEST_CASE("marching_cubes_cases: neighbours cut their common face alike") {
  const auto& cases = marching_cubes_cases();
  // The segments that a case leaves on a face, as pairs of edges of that face, numbered as in the cube on its lower side.
  const auto segments = [&](int inside, int axis, int side) {
    std::map<std::pair<int, int>, int> edges;
    for (const auto& t : cases[static_cast<std::size_t>(inside)]) {
      for (std::size_t i = 0; i < 3; ++i) ++edges[{t[i], t[(i + 1) % 3]}];
    }
    std::map<std::pair<int, int>, int> found;
    for (const auto& [edge, count] : edges) {
      if (edges.count({edge.second, edge.first}) != 0) continue;
      const auto on_face = [&](int e) {
        const CubeEdge place = cube_edge(e);
        return place.axis != axis && (place.corner >> axis & 1) == side;
      };
      const auto without_side = [&](int e) { return cube_edge(e).axis * 8 + (cube_edge(e).corner & ~(1 << axis)); };
      if (on_face(edge.first) && on_face(edge.second)) found[{without_side(edge.first), without_side(edge.second)}] = count;
    }
    return found;
  };
  for (int axis = 0; axis < 3; ++axis) {
    for (int a = 0; a < 256; ++a) {
      // One neighbour with the same corners on the common face is enough: the cut depends on the face alone, checked by the other cases.
      int b = 0;
      for (int corner = 0; corner < 8; ++corner) {
        if ((corner >> axis & 1) == 0 && (a >> (corner | 1 << axis) & 1) != 0) b |= 1 << corner;
        if ((corner >> axis & 1) == 1 && ((a * 37 + corner) & 2) != 0) b |= 1 << corner;
      }
      const auto upper = segments(a, axis, 1);
      const auto lower = segments(b, axis, 0);
      REQUIRE(upper.size() == lower.size());
      for (const auto& [segment, count] : upper) REQUIRE(lower.count({segment.second, segment.first}) == 1);
    }
  }
}

/// A sphere seen from twelve sides.
TsdfVolume sphere_volume(const Context& context, const Scene& scene) {
  TsdfVolume volume(context, {});
  const float golden = 1.618034F;
  for (const float a : {-1.0F, 1.0F}) {
    for (const float b : {-golden, golden}) {
      for (int axis = 0; axis < 3; ++axis) {
        Eigen::Vector3f direction = Eigen::Vector3f::Zero();
        direction[axis] = a;
        direction[(axis + 1) % 3] = b;
        const Eigen::Vector3f centre = scene.sphere_centre_world.cast<float>();
        const SE3 pose = test::look_at(centre + direction.normalized(), centre);
        volume.integrate(test::render(scene, pose).view(), pose);
      }
    }
  }
  return volume;
}

TEST_CASE("extract_mesh: a sphere is watertight across blocks, round, coloured and faces outwards") {
  Scene scene;
  scene.has_room = false;
  ContextOptions options;
  options.num_threads = 1;
  const Context context(options);
  const Mesh mesh = extract_mesh(sphere_volume(context, scene));
  REQUIRE(mesh.vertices.size() > 15000);
  REQUIRE(mesh.normals.size() == mesh.vertices.size());
  REQUIRE(mesh.colours.size() == mesh.vertices.size());
  const auto edges = directed_edges(mesh);
  for (const auto& [edge, count] : edges) {
    REQUIRE(count == 1);
    REQUIRE(edges.count({edge.second, edge.first}) == 1);
  }
  // Euler's formula for one closed surface without handles.
  REQUIRE(static_cast<int>(mesh.vertices.size()) - static_cast<int>(edges.size() / 2) + static_cast<int>(mesh.triangles.size()) == 2);
  std::vector<double> errors_m;
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
    const Eigen::Vector3d from_centre = mesh.vertices[v].cast<double>() - scene.sphere_centre_world;
    errors_m.push_back(std::abs(from_centre.norm() - scene.sphere_radius_m));
    REQUIRE(errors_m.back() < 0.01);
    REQUIRE(from_centre.normalized().dot(mesh.normals[v].cast<double>()) > 0.7);
    const auto expected = [](double x) { return std::min(255.0, std::max(1.0, 128.0 + 60.0 * x)); };
    REQUIRE(std::abs(mesh.colours[v].r - expected(mesh.vertices[v].x())) < 8.0);
  }
  REQUIRE(quantile(errors_m, 0.5) < 0.002);
}

/// The length of a mesh's longest edge, in voxels.
float longest_edge(const Mesh& mesh, float voxel_size_m) {
  float longest_m = 0.0F;
  for (const std::array<int, 3>& t : mesh.triangles) {
    for (std::size_t i = 0; i < 3; ++i) {
      const auto a = static_cast<std::size_t>(t[i]);
      const auto b = static_cast<std::size_t>(t[(i + 1) % 3]);
      longest_m = std::max(longest_m, (mesh.vertices[a] - mesh.vertices[b]).norm());
    }
  }
  return longest_m / voxel_size_m;
}

TEST_CASE("extract_mesh: no edge is longer than the diagonal of a cell, however little of a room was seen") {
  constexpr float kDiagonal = 1.74F;
  const std::string room = GENERATE("office", "lounge", "kitchen");
  for (const int seed : {1, 2}) {
    const auto sequence =
        make_synthetic_sequence(parse_synthetic_spec("synthetic:" + room + "?frames=300&seed=" + std::to_string(seed)), Context());
    TsdfVolume volume(Context(), {});
    int num_fused = 0;
    for (const int last_frame : {3, 60, 61, 200}) {
      // A few frames beside one another, then a gap: views that end in the middle of things.
      for (int i = last_frame - 3; i < last_frame; ++i, ++num_fused) {
        const RgbdFrame frame = sequence->load(i);
        volume.integrate(frame.view(), *frame.world_from_camera);
      }
      const Mesh mesh = extract_mesh(volume);
      CAPTURE(room, seed, num_fused);
      REQUIRE(mesh.triangles.size() > 10000);
      REQUIRE(longest_edge(mesh, volume.settings().voxel_size_m) < kDiagonal);
    }
  }
}

TEST_CASE("extract_mesh: empty for an empty map, smaller with a higher weight") {
  const Context context;
  REQUIRE(extract_mesh(TsdfVolume(context, {})).vertices.empty());
  const TsdfVolume volume = test::fused_arc(context, Scene{}, 3);
  const Mesh all = extract_mesh(volume);
  const Mesh often_seen = extract_mesh(volume, 3);
  REQUIRE(often_seen.triangles.size() < all.triangles.size());
  REQUIRE(often_seen.triangles.size() * 2 > all.triangles.size());
  REQUIRE(extract_mesh(volume, 4).triangles.empty());
  for (const Eigen::Vector3f& vertex : often_seen.vertices) REQUIRE(Scene{}.distance_m(vertex.cast<double>()) < 0.02);
}

}  // namespace
}  // namespace foothold

// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "foothold/evaluation/mesh_distance.h"

#include <cmath>

#include "support/catch.h"

namespace foothold {
namespace {

/// A square of 1 m in the plane z, of two triangles or many.
Mesh square(float z_m, int num_steps) {
  Mesh mesh;
  for (int y = 0; y <= num_steps; ++y) {
    for (int x = 0; x <= num_steps; ++x) {
      mesh.vertices.emplace_back(static_cast<float>(x) / static_cast<float>(num_steps),
                                 static_cast<float>(y) / static_cast<float>(num_steps), z_m);
    }
  }
  const int row = num_steps + 1;
  for (int y = 0; y < num_steps; ++y) {
    for (int x = 0; x < num_steps; ++x) {
      const int i = y * row + x;
      mesh.triangles.push_back({i, i + 1, i + row});
      mesh.triangles.push_back({i + 1, i + row + 1, i + row});
    }
  }
  return mesh;
}

}  // namespace

TEST_CASE("mesh_distance: parallel squares are as far apart as their planes, however they are cut") {
  for (const int num_steps : {1, 7}) {
    const MeshDistance distance = mesh_distance(square(0.02F, 30), square(0.0F, num_steps), 0.01);
    CHECK(distance.num_near == distance.num_vertices);
    CHECK(distance.num_within == 0);
    CHECK(distance.mean_m == Approx(0.02));
    CHECK(distance.rmse_m == Approx(0.02));
    CHECK(distance.p95_m == Approx(0.02));
  }
}

TEST_CASE("mesh_distance: beyond an edge the distance is to the edge") {
  Mesh point;
  point.vertices = {{-0.03F, 0.5F, 0.0F}, {-0.003F, -0.004F, 0.0F}};
  const MeshDistance distance = mesh_distance(point, square(0.0F, 3), 0.01);
  CHECK(distance.num_within == 1);
  CHECK(distance.mean_m == Approx((0.03 + 0.005) / 2.0));
}

TEST_CASE("mesh_distance: what is farther than the limit has no counterpart") {
  const MeshDistance distance = mesh_distance(square(0.2F, 4), square(0.0F, 4), 0.01);
  CHECK(distance.num_vertices == 25);
  CHECK(distance.num_near == 0);
  CHECK(std::isnan(distance.mean_m));
  CHECK(mesh_distance({}, square(0.0F, 1), 0.01).num_vertices == 0);
  CHECK(mesh_distance(square(0.0F, 1), {}, 0.01).num_near == 0);
}

TEST_CASE("mesh_distance: degenerate triangles are their edges") {
  Mesh line;
  line.vertices = {{0, 0, 0}, {1, 0, 0}, {0.5F, 0, 0}};
  line.triangles = {{0, 1, 2}, {0, 0, 0}};
  Mesh point;
  point.vertices = {{0.7F, 0.01F, 0.0F}};
  CHECK(mesh_distance(point, line, 0.02).mean_m == Approx(0.01));
}

}  // namespace foothold

// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "common/map_from_above.h"

#include "support/catch.h"

namespace foothold::apps {
namespace {

constexpr float kTolerance_m = 0.05F;  // a cell

/// A level camera that looks along z: x is to the right, y down.
SE3 camera_at(float x, float y, float z) { return {Eigen::Matrix3f::Identity(), {x, y, z}}; }

Mesh mesh_of(const std::vector<Eigen::Vector3f>& points) {
  Mesh mesh;
  mesh.vertices = points;
  return mesh;
}

}  // namespace

TEST_CASE("MapFromAbove: forward is up on the picture, right is right") {
  MapFromAbove map;
  map.add_stop(camera_at(0, 0, 0), ViewState::kTracking, false, false);
  map.add_stop(camera_at(1, 0, 2), ViewState::kLost, true, true);
  const MapContents contents = map.contents();
  REQUIRE(contents.trajectory.size() == 2);
  CHECK(contents.trajectory[1].x_m == Approx(1.0F));
  CHECK(contents.trajectory[1].y_m == Approx(-2.0F));
  CHECK(contents.trajectory[1].relocalised);
  CHECK(contents.trajectory[1].joined);
  REQUIRE(contents.camera.has_value());
  CHECK(contents.camera->x_m == Approx(1.0F));
  CHECK(contents.camera->forward_y == Approx(-1.0F));
}

TEST_CASE("MapFromAbove: the highest surface below the ceiling shows") {
  MapFromAbove map;
  map.add_stop(camera_at(0, 0, 0), ViewState::kTracking, false, false);
  Mesh mesh = mesh_of({{0.0F, 1.0F, 1.0F}, {0.0F, 0.5F, 1.0F}, {0.0F, -1.0F, 1.0F}, {2.0F, 1.0F, 1.0F}});
  mesh.colours = {{1, 1, 1}, {2, 2, 2}, {3, 3, 3}, {4, 4, 4}};  // floor, table, ceiling, floor elsewhere
  map.add_surfaces(mesh);
  const MapContents contents = map.contents();
  REQUIRE(contents.cells.size() == 2);
  for (const MapCell& cell : contents.cells) {
    CHECK(std::abs(cell.y_m + 1.0F) < kTolerance_m);
    CHECK(cell.colour.r == (cell.x_m > 1.0F ? 4 : 2));
  }
}

TEST_CASE("MapFromAbove: surfaces that face up make a tilted camera's map level") {
  const float angle = 0.5F;  // looks down by so much [rad]
  SE3 tilted;
  tilted.rotation << 1, 0, 0, 0, std::cos(angle), std::sin(angle), 0, -std::sin(angle), std::cos(angle);
  SurfaceMap rendering;
  rendering.camera = {{100.0F, 100.0F, 7.5F, 7.5F}, 16, 16, tilted};
  const Eigen::Vector3f normal_camera = tilted.rotation.transpose() * Eigen::Vector3f(0.0F, -1.0F, 0.0F);
  rendering.pixels.resize(256);
  rendering.colours.resize(256);
  for (std::size_t i = 0; i < 256; ++i) {
    rendering.pixels[i] = {normal_camera.x(), normal_camera.y(), normal_camera.z(), 1.0F};
    rendering.colours[i] = {9, 9, 9};
  }
  MapFromAbove map;
  map.add_stop(tilted, ViewState::kTracking, false, false);
  map.add_surfaces(rendering);
  map.add_stop({tilted.rotation, {0.0F, 5.0F, 0.0F}}, ViewState::kTracking, false, false);  // straight down in the world
  const MapStop below = map.contents().trajectory.back();
  CHECK(std::hypot(below.x_m, below.y_m) < kTolerance_m);
}

TEST_CASE("MapFromAbove: empty and cleared maps are empty") {
  MapFromAbove map;
  CHECK(map.contents().cells.empty());
  CHECK_FALSE(map.contents().camera.has_value());
  map.add_stop(camera_at(0, 0, 0), ViewState::kTracking, false, false);
  map.clear();
  CHECK(map.contents().trajectory.empty());
}

}  // namespace foothold::apps

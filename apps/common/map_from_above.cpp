// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "common/map_from_above.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace foothold::apps {
namespace {

constexpr float kCell_m = 0.04F;
/// Normals this near to the camera's own up are those of floors and tables: cosine of the angle.
constexpr float kFacesUp = 0.8F;
/// How far above the highest camera the map is cut [m].
constexpr float kHeadroom_m = 0.2F;
/// A cell must be met this often to be more than a speck.
constexpr int kMinSeen = 3;

/// 21 bits a coordinate: 84 km of cells.
std::uint64_t key_of(const Eigen::Vector3f& point) {
  std::uint64_t key = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const auto index = static_cast<std::int64_t>(std::floor(point[axis] / kCell_m));
    key = key << 21U | (static_cast<std::uint64_t>(index) & 0x1fffffU);
  }
  return key;
}

/// The first of several directions that has a part across `up`, made perpendicular to it and of unit length.
Eigen::Vector3f across(const Eigen::Vector3f& up, std::initializer_list<Eigen::Vector3f> directions) {
  for (const Eigen::Vector3f& direction : directions) {
    const Eigen::Vector3f part = direction - up * up.dot(direction);
    if (part.norm() > 0.3F) return part.normalized();
  }
  return up.unitOrthogonal();
}

}  // namespace

void MapFromAbove::add_point(const Eigen::Vector3f& point_world, Rgb8 colour, int num_seen) {
  Cell& cell = cells_[key_of(point_world)];
  cell.point_world = point_world;
  cell.colour = colour;
  cell.num_seen = std::min(cell.num_seen + num_seen, kMinSeen);
}

void MapFromAbove::add_surfaces(const SurfaceMap& rendering) {
  const std::vector<SurfacePixel> pixels = rendering.pixels.to_host();
  const std::vector<Rgb8> colours = rendering.colours.to_host();
  const RenderCamera& camera = rendering.camera;
  const Eigen::Vector3f camera_up =
      camera_up_sum_.norm() > 0.0F ? camera_up_sum_.normalized().eval() : -camera.world_from_camera.rotation.col(1);
  for (std::size_t i = 0; i < pixels.size() && i < colours.size(); ++i) {
    const SurfacePixel& pixel = pixels[i];
    if (pixel.depth_m <= 0.0F) continue;
    const auto u = static_cast<float>(i % static_cast<std::size_t>(camera.width));
    const auto v = static_cast<float>(i / static_cast<std::size_t>(camera.width));
    add_point(camera.world_from_camera * camera.intrinsics.back_project(u, v, pixel.depth_m), colours[i], 1);
    if (!pixel.has_normal()) continue;
    const Eigen::Vector3f normal = camera.world_from_camera.rotation * Eigen::Vector3f(pixel.normal_x, pixel.normal_y, pixel.normal_z);
    if (normal.dot(camera_up) > kFacesUp) normal_up_sum_ += normal;
  }
}

void MapFromAbove::add_surfaces(const Mesh& mesh) {
  constexpr Rgb8 kGrey = {150, 150, 150};
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
    add_point(mesh.vertices[i], mesh.colours.empty() ? kGrey : mesh.colours[i], kMinSeen);
  }
}

void MapFromAbove::add_stop(const SE3& world_from_camera, ViewState state, bool relocalised, bool joined) {
  camera_up_sum_ -= world_from_camera.rotation.col(1);  // camera y points down
  stops_.push_back({world_from_camera, state, relocalised, joined && !stops_.empty()});
}

void MapFromAbove::clear() { *this = MapFromAbove(); }

Eigen::Matrix3f MapFromAbove::axes() const {
  const SE3 first = stops_.empty() ? SE3{} : stops_.front().world_from_camera;
  const Eigen::Vector3f camera_up = camera_up_sum_.norm() > 1e-3F ? camera_up_sum_.normalized() : -first.rotation.col(1);
  const Eigen::Vector3f up = normal_up_sum_.norm() > 100.0F ? normal_up_sum_.normalized() : camera_up;
  const Eigen::Vector3f forward = across(up, {first.rotation.col(2), -first.rotation.col(1)});
  Eigen::Matrix3f axes;
  axes << forward.cross(up), -forward, up;
  return axes;
}

MapContents MapFromAbove::contents() const {
  const Eigen::Matrix3f flat_from_world = axes().transpose();
  MapContents result;
  result.cell_m = kCell_m;
  float highest_m = -std::numeric_limits<float>::max();
  for (const Stop& stop : stops_) highest_m = std::max(highest_m, (flat_from_world * stop.world_from_camera.translation).z());

  struct Column {
    float height_m;
    const Cell* cell;
    Eigen::Vector3f flat;
  };
  std::unordered_map<std::uint64_t, Column> columns;
  columns.reserve(cells_.size());
  for (const auto& [key, cell] : cells_) {
    if (cell.num_seen < kMinSeen) continue;
    const Eigen::Vector3f flat = flat_from_world * cell.point_world;
    if (!stops_.empty() && flat.z() > highest_m + kHeadroom_m) continue;
    const auto [column, is_new] = columns.try_emplace(key_of({flat.x(), flat.y(), 0.0F}), Column{flat.z(), &cell, flat});
    if (!is_new && flat.z() > column->second.height_m) column->second = {flat.z(), &cell, flat};
  }
  result.cells.reserve(columns.size());
  for (const auto& [key, column] : columns) result.cells.push_back({column.flat.x(), column.flat.y(), column.cell->colour});
  for (const Stop& stop : stops_) {
    const Eigen::Vector3f flat = flat_from_world * stop.world_from_camera.translation;
    result.trajectory.push_back({flat.x(), flat.y(), stop.state, stop.relocalised, stop.joined});
  }
  if (stops_.empty()) return result;
  const SE3& last = stops_.back().world_from_camera;
  const Eigen::Vector3f flat = flat_from_world * last.translation;
  const Eigen::Vector3f up = flat_from_world.row(2);
  const Eigen::Vector3f forward = flat_from_world * across(up, {last.rotation.col(2), -last.rotation.col(1)});
  result.camera = MapCamera{flat.x(), flat.y(), forward.x(), forward.y(), true};
  return result;
}

}  // namespace foothold::apps

// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// Gathers what a map from above shows: surfaces, trajectory, camera.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <unordered_map>
#include <vector>

#include "common/view_contents.h"
#include "foothold/base/mesh.h"
#include "foothold/base/se3.h"
#include "foothold/fusion/raycaster.h"

namespace foothold::apps {

/// Keeps coarse coloured cells of the seen surfaces and lays them flat.
///
/// Up is the mean normal of the seen surfaces that face up as the camera was held; forward is where the first frame looked. What is above
/// the camera, such as a ceiling, is cut away.
class MapFromAbove {
 public:
  /// Adds the surfaces of a rendering. @pre It has colours.
  void add_surfaces(const SurfaceMap& rendering);
  /// Adds a mesh, such as that of a loaded map; without colours, in grey.
  void add_surfaces(const Mesh& mesh);
  /// Adds the camera's place at one frame.
  void add_stop(const SE3& world_from_camera, ViewState state, bool relocalised, bool joined);
  void clear();

  MapContents contents() const;

 private:
  struct Cell {
    Eigen::Vector3f point_world;  // the last one seen
    Rgb8 colour;
    int num_seen = 0;
  };
  struct Stop {
    SE3 world_from_camera;
    ViewState state;
    bool relocalised;
    bool joined;
  };

  void add_point(const Eigen::Vector3f& point_world, Rgb8 colour, int num_seen);
  /// Columns: right, backward and up in the world.
  Eigen::Matrix3f axes() const;

  std::unordered_map<std::uint64_t, Cell> cells_;
  std::vector<Stop> stops_;
  Eigen::Vector3f camera_up_sum_ = Eigen::Vector3f::Zero();
  Eigen::Vector3f normal_up_sum_ = Eigen::Vector3f::Zero();
};

}  // namespace foothold::apps

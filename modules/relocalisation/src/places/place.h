// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// What is remembered of one place: where cameras have been that are near one another.
#pragma once

#include <Eigen/Core>
#include <cstdint>

#include "clustering/leaf_modes.h"
#include "examples/learnt_views.h"
#include "foothold/base/array.h"
#include "foothold/base/se3.h"
#include "reservoirs/leaf_reservoirs.h"

namespace foothold {

/// A place has a frame of its own, turned as the world is, with its first camera at the origin: so its coordinates stay small wherever in
/// the world it lies.
struct Place {
  Eigen::Vector3f origin_world;  ///< [m]
  LearntViews learnt;
  LeafReservoirs reservoirs;
  LeafModes modes;
  Array<ReservoirPoint> latest;   ///< what the camera that was learnt last saw, on its pixel grid; (0, 0, 0) where there was no depth
  bool is_used = false;           ///< something was learnt
  bool is_settled = true;         ///< all that was learnt is in the modes
  bool is_thin = false;           ///< thinning gave back little, and nothing was learnt since
  std::size_t counted_bytes = 0;  ///< by ScenePlaces::count_bytes()

  std::size_t state_bytes(const Context& context) const {
    return learnt.state_bytes() + reservoirs.state_bytes(context) + modes.state_bytes(context) + latest.num_bytes();
  }
  SE3 place_from_camera(const SE3& world_from_camera) const {
    return {world_from_camera.rotation, world_from_camera.translation - origin_world};
  }
  SE3 world_from_camera(const SE3& place_from_camera) const {
    return {place_from_camera.rotation, place_from_camera.translation + origin_world};
  }
};

}  // namespace foothold

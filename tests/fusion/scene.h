// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// A scene with a closed form, for tests: a box-shaped room seen from inside with a sphere in it. Everything in double precision.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "foothold/api/frame.h"
#include "foothold/fusion/raycaster.h"
#include "foothold/fusion/tsdf_volume.h"
#include "support/random_motion.h"

namespace foothold::test {

/// A context on the host.
Context make_context(int num_threads = 1);

/// A room of [-1.5, 1.5] x [-1.2, 1.2] x [-1.5, 1.5] m around the origin, y down, with a sphere of radius 0.4 m.
struct Scene {
  Eigen::Vector3d half_size_m{1.5, 1.2, 1.5};
  Eigen::Vector3d sphere_centre_world{0.2, 0.3, 0.7};
  double sphere_radius_m = 0.4;
  bool has_room = true;

  /// Depth z [m] along the ray of a pixel, 0 if it meets nothing.
  double depth_m(const Intrinsics& intrinsics, const SE3& world_from_camera, int u, int v) const;
  /// The distance [m] from a point to the nearest surface.
  double distance_m(const Eigen::Vector3d& point_world) const;
};

/// A frame of the scene, coloured by the world coordinates of what it sees.
RgbdFrame render(const Scene& scene, const SE3& world_from_camera, int width = 320, int height = 240);

/// The pose at `position`, looking at `target`, upright.
SE3 look_at(const Eigen::Vector3f& position, const Eigen::Vector3f& target);

/// A camera of 90 degrees on a short arc through the scene. t in [0, 1].
SE3 pose_on_arc(float t);

/// A volume into which `num_frames` frames along the arc were fused.
TsdfVolume fused_arc(const Context& context, const Scene& scene, int num_frames, const TsdfSettings& settings = {});

/// The camera that took a frame.
RenderCamera camera_of(const RgbdFrame& frame);

}  // namespace foothold::test

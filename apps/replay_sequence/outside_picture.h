// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// A picture of the whole reconstruction.
#pragma once

#include <vector>

#include "foothold/base/image.h"
#include "foothold/base/mesh.h"
#include "foothold/fusion/tsdf_volume.h"

namespace foothold::replay {

/// Renders the map from behind and above where the cameras looked from, far enough to show nearly all of it. Surfaces that face away, such
/// as the near walls and the ceiling of a room seen from outside, are looked through.
///
/// @param mesh        The map's surface.
/// @param trajectory  Poses of the camera (world_from_camera): they say where up and forward are.
/// @return Empty if the map or the trajectory is.
Image<Rgb8> picture_from_outside(const TsdfVolume& volume, const Mesh& mesh, const std::vector<SE3>& trajectory, int width, int height);

}  // namespace foothold::replay

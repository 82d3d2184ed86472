// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// Renders analytic rooms by casting one ray through the centre of each pixel.
#pragma once

#include <cstdint>

#include "foothold/base/camera.h"
#include "foothold/base/context.h"
#include "foothold/base/image.h"
#include "foothold/base/se3.h"
#include "foothold/synthetic/room.h"

namespace foothold {

/// What an ideal camera sees.
struct RenderedView {
  Image<float> depth;             ///< z [m]; 0 where the ray meets nothing
  Image<Rgb8> colour;             ///< black where the ray meets nothing
  Image<float> incidence_cosine;  ///< |cos| of the angle between ray and surface normal, in [0, 1]
  Image<std::int32_t> primitive;  ///< index into Room::primitives; -1 where the ray meets nothing
};

/// Renders a room. Solids are seen from outside only: a camera inside one looks through it.
///
/// @param world_from_camera  Camera x right, y down, z forward.
/// @pre Valid intrinsics, positive width and height.
/// Cost: about 30 ms of one CPU thread for 640x480 pixels and 300 primitives.
RenderedView render(const Room& room, const Intrinsics& intrinsics, const SE3& world_from_camera, int width, int height);

/// The same on the threads of a context, with the same result.
RenderedView render(const Context& context, const Room& room, const Intrinsics& intrinsics, const SE3& world_from_camera, int width,
                    int height);

}  // namespace foothold

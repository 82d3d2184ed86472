// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// Where in the image a primitive can appear at all.
#pragma once

#include <cstdint>
#include <vector>

#include "foothold/base/camera.h"
#include "foothold/base/se3.h"
#include "foothold/synthetic/room.h"
#include "tile.h"

namespace foothold::synthetic_detail {

/// A primitive that may be visible: a rectangle of pixels that encloses it, and a depth nearer than all of it.
struct VisiblePrimitive {
  std::int32_t index = 0;
  int left = 0, top = 0, right = 0, bottom = 0;  ///< inclusive [px]
  float nearest_m = 0.0F;
  PrimitiveView view{};
};

/// The primitives that may be visible, nearest first.
std::vector<VisiblePrimitive> visible_primitives(const Room& room, const Intrinsics& intrinsics, const SE3& world_from_camera, int width,
                                                 int height);

}  // namespace foothold::synthetic_detail

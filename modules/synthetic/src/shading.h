// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// The colour of a surface point under a room's lamps.
#pragma once

#include <cstdint>

#include "foothold/base/camera.h"
#include "foothold/base/image.h"
#include "foothold/base/se3.h"
#include "foothold/synthetic/room.h"

namespace foothold::synthetic_detail {

struct Shade {
  Rgb8 colour;
  float incidence_cosine = 0.0F;  ///< |cos| between ray and normal
};

/// Shades hits of one camera.
class Shading {
 public:
  Shading(const Room& room, const Intrinsics& intrinsics, const SE3& world_from_camera)
      : room_(room), pixel_size_(1.0F / intrinsics.fx), world_from_camera_(world_from_camera) {}

  /// The look of a primitive where the ray of camera direction (x, y, 1) meets it at depth t.
  Shade operator()(std::int32_t primitive, float x, float y, float t) const;

 private:
  const Room& room_;
  float pixel_size_;  ///< of the image plane at depth 1
  const SE3& world_from_camera_;
};

}  // namespace foothold::synthetic_detail

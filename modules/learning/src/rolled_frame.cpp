// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "rolled_frame.h"

#include <cmath>

namespace foothold {

RgbdFrame rolled_frame(const RgbdFrame& frame, float angle_rad) {
  RgbdFrame rolled;
  rolled.depth = Image<float>(frame.depth.width(), frame.depth.height(), 0.0F);
  rolled.colour = Image<Rgb8>(frame.depth.width(), frame.depth.height());
  rolled.calibration = frame.calibration;
  rolled.index = frame.index;
  rolled.timestamp_s = frame.timestamp_s;

  SE3 old_from_new;
  const float c = std::cos(angle_rad);
  const float s = std::sin(angle_rad);
  old_from_new.rotation << c, -s, 0.0F, s, c, 0.0F, 0.0F, 0.0F, 1.0F;
  if (frame.world_from_camera) rolled.world_from_camera = *frame.world_from_camera * old_from_new;

  const Intrinsics& camera = frame.calibration.depth;
  for (int v = 0; v < rolled.depth.height(); ++v) {
    for (int u = 0; u < rolled.depth.width(); ++u) {
      const Eigen::Vector2f old_pixel =
          camera.project(old_from_new * camera.back_project(static_cast<float>(u), static_cast<float>(v), 1.0F));
      const int old_u = static_cast<int>(std::lround(old_pixel.x()));
      const int old_v = static_cast<int>(std::lround(old_pixel.y()));
      if (!frame.depth.view().contains(old_u, old_v)) continue;
      rolled.depth(u, v) = frame.depth(old_u, old_v);
      rolled.colour(u, v) = frame.colour(old_u, old_v);
    }
  }
  return rolled;
}

}  // namespace foothold

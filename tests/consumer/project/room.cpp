// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "room.h"

#include <algorithm>
#include <cmath>

namespace room {

Images render(const foothold::SE3& world_from_camera) {
  const Eigen::Vector3f half_size_m(2.2F, 1.4F, 1.8F);
  Images images;
  for (int v = 0; v < kHeight; ++v) {
    for (int u = 0; u < kWidth; ++u) {
      const Eigen::Vector3f ray = kCamera.back_project(static_cast<float>(u), static_cast<float>(v), 1.0F);
      const Eigen::Vector3f direction = world_from_camera.rotation * ray;
      float depth_m = 1e9F;
      for (int axis = 0; axis < 3; ++axis) {
        const float wall_m = std::copysign(half_size_m[axis], direction[axis]);
        if (direction[axis] != 0.0F) depth_m = std::min(depth_m, (wall_m - world_from_camera.translation[axis]) / direction[axis]);
      }
      const Eigen::Vector3f p = world_from_camera.translation + depth_m * direction;
      const auto pixel = static_cast<std::size_t>(v * kWidth + u);
      images.depth_m[pixel] = depth_m;
      for (int channel = 0; channel < 3; ++channel) {
        const float wave = std::sin(4.0F * p[channel] + 3.0F * p[(channel + 1) % 3] * p[channel]) + std::sin(9.0F * p[(channel + 2) % 3]);
        images.rgb[3 * pixel + static_cast<std::size_t>(channel)] = static_cast<std::uint8_t>(127.0F + 60.0F * wave);
      }
    }
  }
  return images;
}

foothold::SE3 pose_at(int step) {
  const float angle = 0.02F * static_cast<float>(step);
  foothold::Tangent6 twist;
  twist << 0.1F, angle, 0.0F, 0.3F * std::sin(angle), 0.05F, 0.2F * angle;
  return foothold::se3_exp(twist);
}

}  // namespace room

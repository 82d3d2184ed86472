// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// A painted room and a walk through it.
#pragma once

#include <cstdint>
#include <vector>

#include "foothold/api/frame.h"

namespace room {

constexpr int kWidth = 320;
constexpr int kHeight = 240;
inline const foothold::Intrinsics kCamera{290.0F, 290.0F, 160.0F, 120.0F};

/// The images that a tracker would own.
struct Images {
  std::vector<float> depth_m = std::vector<float>(kWidth * kHeight);
  std::vector<std::uint8_t> rgb = std::vector<std::uint8_t>(3 * kWidth * kHeight);

  foothold::Frame frame() const {
    foothold::Frame result;
    result.depth = {depth_m.data(), kWidth, kHeight, foothold::MemoryKind::kHost};
    result.colour = {rgb.data(), kWidth, kHeight, 3, foothold::MemoryKind::kHost};
    result.calibration = {kCamera, kCamera, foothold::SE3{}};
    return result;
  }
};

/// Renders the inside of a box with waves on its walls, seen from a pose.
Images render(const foothold::SE3& world_from_camera);

/// The camera's pose after some steps.
foothold::SE3 pose_at(int step);

}  // namespace room

// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// A host with images of its own: it teaches each relocaliser a walk through a painted room, loses track, and asks where it is.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <memory>
#include <vector>

#include "foothold/relocalisation/forest_relocaliser.h"
#include "foothold/relocalisation/keyframe_relocaliser.h"

namespace {

constexpr int kWidth = 320;
constexpr int kHeight = 240;
const foothold::Intrinsics kCamera{290.0F, 290.0F, 160.0F, 120.0F};

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

bool recovers(foothold::Relocaliser& relocaliser, const char* name) {
  constexpr int kLost = 20;
  for (int step = 0; step <= kLost; ++step) {
    relocaliser.train(render(pose_at(step)).frame(), pose_at(step));
    relocaliser.update();
  }
  const std::vector<foothold::PoseEstimate> estimates = relocaliser.relocalise(render(pose_at(kLost)).frame());
  if (estimates.empty()) {
    std::printf("%s: found nothing\n", name);
    return false;
  }
  const float error_m = foothold::translation_distance_m(estimates.front().world_from_camera, pose_at(kLost));
  std::printf("%s: %zu estimates, the best off by %.1f mm with confidence %.2f\n", name, estimates.size(),
              static_cast<double>(error_m) * 1e3, static_cast<double>(estimates.front().confidence));
  return error_m < 0.25F;
}

}  // namespace

int main() {
  const foothold::Context context;
  std::vector<std::unique_ptr<foothold::Relocaliser>> relocalisers;
  relocalisers.push_back(std::make_unique<foothold::ForestRelocaliser>(context));
  relocalisers.push_back(std::make_unique<foothold::KeyframeRelocaliser>(context));
  return recovers(*relocalisers[0], "forest") && recovers(*relocalisers[1], "ferns") ? 0 : 1;
}

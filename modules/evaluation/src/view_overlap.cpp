// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "foothold/evaluation/view_overlap.h"

#include <algorithm>
#include <cmath>

#include "foothold/base/contract.h"

namespace foothold {
namespace {

constexpr int kColumns = 20;
constexpr int kRows = 15;
constexpr float kSameSurface_m = 0.1F;

/// Surface points of a grid of pixels [world].
std::vector<Eigen::Vector3f> sampled_points(const RgbdFrame& view) {
  std::vector<Eigen::Vector3f> points;
  for (int row = 0; row < kRows; ++row) {
    for (int column = 0; column < kColumns; ++column) {
      const int u = (2 * column + 1) * view.depth.width() / (2 * kColumns);
      const int v = (2 * row + 1) * view.depth.height() / (2 * kRows);
      const float z = view.depth(u, v);
      if (!is_valid_depth(z)) continue;
      const Eigen::Vector3f point = view.calibration.depth.back_project(static_cast<float>(u), static_cast<float>(v), z);
      points.push_back(*view.world_from_camera * point);
    }
  }
  return points;
}

bool sees(const RgbdFrame& frame, const Eigen::Vector3f& point_camera) {
  if (point_camera.z() <= 0.0F) return false;
  const Eigen::Vector2f pixel = frame.calibration.depth.project(point_camera);
  const auto last_u = static_cast<float>(frame.depth.width() - 1);
  const auto last_v = static_cast<float>(frame.depth.height() - 1);
  if (pixel.x() < 0.0F || pixel.y() < 0.0F || pixel.x() > last_u || pixel.y() > last_v) return false;
  const float z = frame.depth(static_cast<int>(std::lround(pixel.x())), static_cast<int>(std::lround(pixel.y())));
  return is_valid_depth(z) && std::fabs(z - point_camera.z()) <= kSameSurface_m;
}

}  // namespace

double share_seen(const RgbdFrame& view, const std::vector<std::shared_ptr<const RgbdFrame>>& others) {
  FOOTHOLD_EXPECTS(view.world_from_camera.has_value());
  const std::vector<Eigen::Vector3f> points = sampled_points(view);
  if (points.empty()) return 0.0;
  std::vector<bool> seen(points.size(), false);
  for (const auto& other : others) {
    FOOTHOLD_EXPECTS(other->world_from_camera.has_value());
    const SE3 camera_from_world = other->world_from_camera->inverse();
    for (std::size_t i = 0; i < points.size(); ++i) seen[i] = seen[i] || sees(*other, camera_from_world * points[i]);
  }
  return static_cast<double>(std::count(seen.begin(), seen.end(), true)) / static_cast<double>(points.size());
}

}  // namespace foothold

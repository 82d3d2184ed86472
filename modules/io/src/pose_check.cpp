// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "pose_check.h"

#include <algorithm>
#include <cmath>

namespace foothold::io {
namespace {

/// About so many points are projected along the longer side of an image.
constexpr int kPointsPerSide = 40;
/// Depths that differ by less are the same surface, as noise of depth cameras at 3 m goes.
constexpr double kSameDepth_m = 0.02;
constexpr double kSameDepth = 0.02;

struct Count {
  int num_points = 0;
  int num_seen = 0;
  int num_agreeing = 0;
  double score = 0.0;
};

Count count_agreeing(const FramePair& pair, const Intrinsics& k, const Reading& reading) {
  const RecordedPose world_from_a = apply(reading.convention, pair.world_from_a);
  const RecordedPose world_from_b = apply(reading.convention, pair.world_from_b);
  const Eigen::Matrix3d b_from_world = world_from_b.rotation.transpose();
  const Eigen::Matrix3d rotation = b_from_world * world_from_a.rotation;
  const Eigen::Vector3d translation = b_from_world * (world_from_a.translation_m - world_from_b.translation_m) / reading.depth_factor;
  const Image<float>& depth_a = *pair.depth_a;
  const int width = depth_a.width();
  const int height = depth_a.height();
  const int step = std::max(1, std::max(width, height) / kPointsPerSide);
  Count count;
  for (int v = step / 2; v < height; v += step) {
    for (int u = step / 2; u < width; u += step) {
      if (!is_valid_depth(depth_a(u, v))) continue;
      const Eigen::Vector3f point_a = k.back_project(static_cast<float>(u), static_cast<float>(v), depth_a(u, v));
      const Eigen::Vector3d point = rotation * point_a.cast<double>() + translation;
      const double seen_u = static_cast<double>(k.fx) * point.x() / point.z() + static_cast<double>(k.cx);
      const double seen_v = static_cast<double>(k.fy) * point.y() / point.z() + static_cast<double>(k.cy);
      ++count.num_points;
      const bool inside = point.z() > 0.0 && seen_u > -0.5 && seen_v > -0.5 && seen_u < width - 0.5 && seen_v < height - 0.5;
      if (!inside) continue;
      const float depth_b = (*pair.depth_b)(static_cast<int>(std::lround(seen_u)), static_cast<int>(std::lround(seen_v)));
      if (!is_valid_depth(depth_b)) {
        --count.num_points;  // a hole says nothing
        continue;
      }
      ++count.num_seen;
      const double tolerance = kSameDepth_m / reading.depth_factor + kSameDepth * point.z();
      const double misfit = std::abs(static_cast<double>(depth_b) - point.z()) / tolerance;
      if (misfit >= 1.0) continue;
      ++count.num_agreeing;
      count.score += 1.0 - misfit;
    }
  }
  return count;
}

std::vector<Reading> make_readings() {
  using Axes = PoseConvention::Axes;
  std::vector<PoseConvention> axes;
  for (const bool w_first : {false, true}) {
    for (const bool inverse : {false, true}) {
      for (const Axes each : {Axes::kVision, Axes::kOpenGl, Axes::kRos}) axes.push_back({w_first, inverse, false, each, 1.0});
      axes.push_back({w_first, inverse, true, Axes::kVision, 1.0});
    }
  }
  std::vector<Reading> readings;
  for (const PoseConvention& each : axes) {
    if (each != PoseConvention{}) readings.push_back({each, 1.0});
  }
  for (const PoseConvention& each : axes) {
    for (const double metres_per_unit : {1e-3, 1e-2}) {
      PoseConvention scaled = each;
      scaled.metres_per_unit = metres_per_unit;
      readings.push_back({scaled, 1.0});
    }
  }
  return readings;
}

}  // namespace

Agreement pose_agreement(const std::vector<FramePair>& pairs, const Intrinsics& camera, const Reading& reading) {
  Count sum;
  for (const FramePair& pair : pairs) {
    const Count count = count_agreeing(pair, camera, reading);
    sum.num_points += count.num_points;
    sum.num_seen += count.num_seen;
    sum.num_agreeing += count.num_agreeing;
    sum.score += count.score;
  }
  if (sum.num_seen == 0) return {};
  return {static_cast<double>(sum.num_agreeing) / sum.num_seen, static_cast<double>(sum.num_seen) / sum.num_points,
          sum.score / sum.num_points};
}

const std::vector<Reading>& other_conventions() {
  static const std::vector<Reading> readings = make_readings();
  return readings;
}

}  // namespace foothold::io

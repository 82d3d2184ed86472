// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// Aligning a pose with points of the whole scene that project into the frame, whatever leaves they lie in: what ICP against a model does,
/// with the reservoirs as the model. Not in the paper. Reference: point-to-plane ICP [Chen1992] with projective association [Blais1995].
#pragma once

#include "pose/rank.h"
#include "pose/surface_kernels.h"

namespace foothold {

/// Points drawn from the whole scene.
struct DrawnPoints {
  Span<const RememberedPoint> points;

  FOOTHOLD_HD static float min_supported(float) { return 100.0F; }
  FOOTHOLD_HD std::size_t size() const { return points.size(); }
  FOOTHOLD_HD bool get(std::size_t i, Eigen::Vector3f& point_scene) const {
    const RememberedPoint& point = points[i];
    point_scene = {point.point_scene[0], point.point_scene[1], point.point_scene[2]};
    return point.valid != 0;
  }
};

/// Steps by one team: in each, the surface at the pixel that each point of the scene projects to is drawn along its normal to that point.
template <class Executor, class Points>
struct AlignByProjection {
  SurfaceEstimator estimator;
  Points points;  ///< with size(), get(), and min_supported(): fewer of so many on surfaces of the frame leave the pose as it is (T)
  int num_steps;
  float distance_m;  ///< points further from the surface count nothing; twice that in the first half of the steps
  AlignmentState* state;

  FOOTHOLD_HD void operator()(const typename Executor::Team& team, std::size_t) const {
    for (int step = 0; step < num_steps; ++step) {
      const bool is_coarse = 2 * step < num_steps;
      if (!take_step(team, distance_m * (is_coarse ? 2.0F : 1.0F), is_coarse ? kCoarseStride : 1)) return;
      team.sync();
    }
  }

 private:
  /// @return False, for every lane, if too few points are supported: the pose stays, and no later step reaches further.
  FOOTHOLD_HD bool take_step(const typename Executor::Team& team, float reach_m, std::uint32_t stride) const {
    const SE3 pose = state->scene_from_camera;
    float sums[kNumSums] = {};
    const auto num_points = static_cast<std::uint32_t>(points.size());
    for (auto i = static_cast<std::uint32_t>(team.lane()) * stride; i < num_points; i += static_cast<std::uint32_t>(team.size()) * stride) {
      Eigen::Vector3f point_scene;
      if (!points.get(i, point_scene)) continue;
      sums[kNumValid] += 1.0F;
      add_point(pose, point_scene, reach_m, sums);
    }
    team.sum_all(sums);
    const auto each = static_cast<float>(stride);  // stands for so many points
    if (each * sums[kNumSupported] < points.min_supported(each * sums[kNumValid])) return false;
    float twist[6];
    if (team.lane() == 0 && solve_for_twist(sums, kDamping, twist)) state->scene_from_camera = perturbed(pose, twist);
    return true;
  }

  static constexpr int kNumSupported = kNumHessian + 6;  ///< points on a surface of the frame
  static constexpr int kNumValid = kNumSupported + 1;    ///< points that exist
  static constexpr int kNumSums = kNumSupported + 2;
  static constexpr float kDamping = 1e-4F;
  static constexpr float kNearestM = 0.3F;
  static constexpr std::uint32_t kCoarseStride = 4;  ///< (T) few points suffice in the first half of the steps

  FOOTHOLD_HD FOOTHOLD_INLINE void add_point(const SE3& pose, const Eigen::Vector3f& point_scene, float reach_m,
                                             float (&sums)[kNumSums]) const {
    const Eigen::Vector3f point_camera = pose.rotation.transpose() * (point_scene - pose.translation);
    if (!(point_camera.z() > kNearestM)) return;
    const Eigen::Vector2f pixel = estimator.intrinsics.project(point_camera);
    const auto u = static_cast<int>(std::floor(pixel.x() + 0.5F));
    const auto v = static_cast<int>(std::floor(pixel.y() + 0.5F));
    if (u < 0 || v < 0 || u >= estimator.image.width || v >= estimator.image.height) return;
    const float gap_m = static_cast<float>(estimator.image.pixels[v * estimator.image.width + u].depth_mm()) * 1e-3F - point_camera.z();
    if (!(std::fabs(gap_m) < kSlantMargin * reach_m)) return;  // before the costly part
    const SurfaceSample surface = estimator.surface_at(u, v);
    if (!has_normal(surface)) return;
    const float residual_m = normal_of(surface).dot(point_camera - point_of(surface));
    const float closeness = 1.0F - residual_m * residual_m / (reach_m * reach_m);
    if (!(closeness > 0.0F)) return;
    add_point_to_plane(pose * point_of(surface), pose.rotation * normal_of(surface), residual_m, closeness * closeness, sums);
    sums[kNumSupported] += 1.0F;
  }

  static constexpr float kSlantMargin = 2.0F;  ///< depths differ by more than the distance on slanted surfaces
};

}  // namespace foothold

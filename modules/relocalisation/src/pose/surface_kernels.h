// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// Surfaces of the frame, and the equations that draw a pose to the surfaces that the scene remembers.
#pragma once

#include <cmath>

#include "pose/align.h"
#include "pose/kabsch.h"
#include "pose/pose_query.h"
#include "pose/refine_kernels.h"

namespace foothold {

FOOTHOLD_HD inline Eigen::Vector3f point_of(const SurfaceSample& surface) {
  return {surface.point_camera[0], surface.point_camera[1], surface.point_camera[2]};
}
FOOTHOLD_HD inline Eigen::Vector3f normal_of(const SurfaceSample& surface) {
  return {surface.normal_camera[0], surface.normal_camera[1], surface.normal_camera[2]};
}
FOOTHOLD_HD inline bool has_normal(const SurfaceSample& surface) { return normal_of(surface).squaredNorm() > 0.0F; }

/// Estimates surfaces from the averaged image.
struct SurfaceEstimator {
  FeatureImageView image;
  Intrinsics intrinsics;  ///< of the averaged image
  int reach;              ///< neighbours' distance [px of the averaged image]

  /// The surface at a pixel of the averaged image; without a normal where it is broken or unmeasured, or at the image's border.
  FOOTHOLD_HD SurfaceSample surface_at(int u, int v) const {
    SurfaceSample surface{};
    Eigen::Vector3f point;
    Eigen::Vector3f left;
    Eigen::Vector3f right;
    Eigen::Vector3f above;
    Eigen::Vector3f below;
    if (point_at(u, v, point) && point_at(u - reach, v, left) && point_at(u + reach, v, right) && point_at(u, v - reach, above) &&
        point_at(u, v + reach, below)) {
      const Eigen::Vector3f normal = cross_product(below - above, right - left);
      const float length = normal.norm();
      const float bend_m = kMaxBend * point.z() * point.z();
      const bool smooth =
          std::fabs(left.z() + right.z() - 2.0F * point.z()) < bend_m && std::fabs(above.z() + below.z() - 2.0F * point.z()) < bend_m;
      if (length > 0.0F && smooth) {
        for (int k = 0; k < 3; ++k) surface.point_camera[k] = point[k];
        for (int k = 0; k < 3; ++k) surface.normal_camera[k] = normal[k] / length;
      }
    }
    return surface;
  }

 private:
  static constexpr float kMaxBend = 0.01F;  ///< second difference of depth at one metre; sensor noise grows with its square [m]

  FOOTHOLD_HD bool point_at(int u, int v, Eigen::Vector3f& point) const {
    if (u < 0 || v < 0 || u >= image.width || v >= image.height) return false;
    const int depth_mm = image.pixels[v * image.width + u].depth_mm();
    if (depth_mm <= 0) return false;
    point = intrinsics.back_project(static_cast<float>(u), static_cast<float>(v), static_cast<float>(depth_mm) * 1e-3F);
    return true;
  }
};

/// Estimates each sample's surface.
struct EstimateSurface {
  SurfaceEstimator estimator;
  int downscale;
  const SampledPixel* sampled;
  SurfaceSample* surfaces;

  FOOTHOLD_HD void operator()(std::size_t i) const {
    surfaces[i] = sampled[i].depth_m > 0.0F ? estimator.surface_at(sampled[i].u / downscale, sampled[i].v / downscale) : SurfaceSample{};
  }
};

/// Adds to the sums of solve_damped(): a point q of a surface with normal n is to move by residual_m along n; all in the scene's frame.
FOOTHOLD_HD FOOTHOLD_INLINE void add_point_to_plane(const Eigen::Vector3f& q, const Eigen::Vector3f& n, float residual_m, float weight,
                                                    float* sums) {
  const Eigen::Vector3f moment = cross_product(q, n);
  const float j[6] = {moment.x(), moment.y(), moment.z(), n.x(), n.y(), n.z()};
  int next = 0;
  for (int a = 0; a < 6; ++a) {
    for (int b = a; b < 6; ++b) sums[next++] += weight * j[a] * j[b];
  }
  for (int a = 0; a < 6; ++a) sums[kNumHessian + a] -= weight * j[a] * residual_m;
}

/// Estimates surfaces of the averaged image.
inline SurfaceEstimator surface_estimator(const PoseQuery& query) {
  constexpr int kNeighbourDistancePx = 8;  // of a 640 px wide frame, each way
  const int downscale = query.image.downscale();
  const int neighbour_distance = scaled_to_width(kNeighbourDistancePx, query.frame.depth.width);
  const int reach = neighbour_distance > downscale ? neighbour_distance / downscale : 1;
  return {query.image.view(), query.averaged_intrinsics(), reach};
}

}  // namespace foothold

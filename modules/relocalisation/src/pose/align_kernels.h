// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// Aligning a pose with the points that the leaves remember, finer than their modes allow. Not in the paper: its counterpart is ICP against
/// a reconstructed model, which a relocaliser does not have. Reference: point-to-plane ICP [Chen1992]; local averages [Levin2003].
#pragma once

#include "pose/refine_kernels.h"
#include "reservoirs/leaf_reservoirs_kernels.h"

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

/// Starts the alignment of the best candidate.
struct BeginAlignment {
  const std::uint64_t* order;
  const SE3* hypotheses;
  AlignmentState* state;

  FOOTHOLD_HD void operator()(std::size_t) const { *state = {hypotheses[hypothesis_of(order[0])], 1.0F, 0}; }
};

/// Puts the aligned pose back in its place.
struct EndAlignment {
  const std::uint64_t* order;
  const AlignmentState* state;
  SE3* hypotheses;
  float* misfits;  ///< per slot

  FOOTHOLD_HD void operator()(std::size_t) const {
    hypotheses[hypothesis_of(order[0])] = state->scene_from_camera;
    misfits[0] = state->misfit;
  }
};

/// Sums the distances along a sample's normal to the points of one of its leaves, weighted by (1 - d^2 / r^2)^2 within the radius.
/// Item i is tree i % num_trees of sample i / num_trees.
struct MeasureOffset {
  LeafReservoirsView reservoirs;
  int num_trees;
  std::size_t pool_size;
  const std::uint32_t* leaves;
  const SurfaceSample* surfaces;
  float radius_mm;
  const AlignmentState* state;
  SurfaceOffset* offsets;

  FOOTHOLD_HD void operator()(std::size_t i) const {
    const std::size_t sample = i / static_cast<std::size_t>(num_trees);
    const std::size_t tree = i % static_cast<std::size_t>(num_trees);
    SurfaceOffset sum{0.0F, 0.0F};
    const SurfaceSample& surface = surfaces[sample];
    const std::uint32_t leaf = leaves[tree * pool_size + sample];
    if (state->ended == 0 && has_normal(surface) && leaf < static_cast<std::uint32_t>(reservoirs.num_leaves)) {
      const SE3& pose = state->scene_from_camera;
      const Eigen::Vector3f p_mm = (pose.rotation * point_of(surface) + pose.translation) * 1000.0F;
      add_leaf(leaf, p_mm, pose.rotation * normal_of(surface), sum);
    }
    offsets[i] = sum;
  }

 private:
  FOOTHOLD_HD FOOTHOLD_INLINE void add_leaf(std::uint32_t leaf, const Eigen::Vector3f& p_mm, const Eigen::Vector3f& n,
                                            SurfaceOffset& sum) const {
    const int num_points = reservoirs.num_stored(leaf);
    const float inverse_radius2 = 1.0F / (radius_mm * radius_mm);
    float weights[kReservoirBlockSize] = {};
    float products[kReservoirBlockSize] = {};
    for (int first = 0; first < num_points; first += kReservoirBlockSize) {
      const ReservoirBlock& block = reservoirs.block_of(leaf, first);
      const int num = num_points - first < kReservoirBlockSize ? num_points - first : kReservoirBlockSize;
      for (int w = 0; w < kReservoirBlockSize; ++w) {
        const float dx = static_cast<float>(block.x_mm[w]) - p_mm.x();
        const float dy = static_cast<float>(block.y_mm[w]) - p_mm.y();
        const float dz = static_cast<float>(block.z_mm[w]) - p_mm.z();
        const float closeness = 1.0F - (dx * dx + dy * dy + dz * dz) * inverse_radius2;
        const float clipped = (closeness > 0.0F) & (w < num) ? closeness : 0.0F;
        const float factor = clipped * clipped;
        weights[w] += factor;
        products[w] += factor * (n.x() * dx + n.y() * dy + n.z() * dz);
      }
    }
    for (int w = 0; w < kReservoirBlockSize; ++w) {
      sum.weight += weights[w];
      sum.offset_mm += products[w];
    }
  }
};

/// One step of the alignment by one team: each sample is drawn along its normal to the mean of the remembered points around it.
template <class Executor>
struct AlignWithPoints {
  int num_trees;
  const SurfaceSample* surfaces;
  const SurfaceOffset* offsets;
  int num_samples;
  float radius_m;
  AlignmentState* state;

  FOOTHOLD_HD void operator()(const typename Executor::Team& team, NoScratch&, std::size_t) const {
    if (state->ended != 0) return;
    const SE3 pose = state->scene_from_camera;
    float sums[kNumAlignmentSums] = {};
    for (int i = team.lane(); i < num_samples; i += team.size()) add_sample(pose, static_cast<std::size_t>(i), sums);
    team.sum_all(sums);
    if (team.lane() != 0) return;
    state->misfit = 1.0F - sums[kFit] / (sums[kNumWithSurface] > 0.0F ? sums[kNumWithSurface] : 1.0F);
    float twist[6];
    if (sums[kNumSupported] >= kMinSupported && solve_damped(sums, kDamping, twist)) {
      state->scene_from_camera = perturbed(pose, twist);
    } else {
      state->ended = 1;
    }
  }

 private:
  // Behind the Hessian and the gradient of solve_damped():
  static constexpr int kNumSupported = kNumHessian + 6;  ///< samples with remembered points around them
  static constexpr int kNumWithSurface = kNumSupported + 1;
  static constexpr int kFit = kNumSupported + 2;
  static constexpr int kNumAlignmentSums = kNumSupported + 3;
  static constexpr float kMinSupported = 50.0F;  ///< samples below which the alignment is not trusted
  static constexpr float kDamping = 1e-4F;
  static constexpr float kMinWeight = 0.5F;  ///< one remembered point nearby

  FOOTHOLD_HD FOOTHOLD_INLINE void add_sample(const SE3& pose, std::size_t i, float (&sums)[kNumAlignmentSums]) const {
    const SurfaceSample& surface = surfaces[i];
    if (!has_normal(surface)) return;
    sums[kNumWithSurface] += 1.0F;
    SurfaceOffset sum{0.0F, 0.0F};
    for (int tree = 0; tree < num_trees; ++tree) {
      const SurfaceOffset& of_tree = offsets[i * static_cast<std::size_t>(num_trees) + static_cast<std::size_t>(tree)];
      sum.weight += of_tree.weight;
      sum.offset_mm += of_tree.offset_mm;
    }
    if (sum.weight < kMinWeight) return;
    const float residual_m = sum.offset_mm / sum.weight * 1e-3F;  // along the normal, from the sample to the remembered surface
    add_point_to_plane(pose.rotation * point_of(surface), pose.rotation * normal_of(surface), residual_m, 1.0F, sums);
    sums[kNumSupported] += 1.0F;
    const float distance = std::fabs(residual_m) / radius_m;
    sums[kFit] += distance < 1.0F ? 1.0F - distance : 0.0F;
  }
};

}  // namespace foothold

// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// Aligning a pose with the points that the leaves remember, finer than their modes allow. Not in the paper: its counterpart is ICP against
/// a reconstructed model, which a relocaliser does not have. Reference: point-to-plane ICP [Chen1992]; local averages [Levin2003].
#pragma once

#include "pose/refine_kernels.h"
#include "reservoirs/leaf_reservoirs_kernels.h"

namespace foothold {

/// Estimates a sample's surface from the averaged image around it.
struct EstimateSurface {
  FeatureImageView image;
  Intrinsics intrinsics;  ///< of the averaged image
  int downscale;
  int reach;  ///< neighbours' distance [px of the averaged image]
  const SampledPixel* sampled;
  SurfaceSample* surfaces;

  FOOTHOLD_HD void operator()(std::size_t i) const {
    SurfaceSample surface{};
    const int u = sampled[i].u / downscale;
    const int v = sampled[i].v / downscale;
    Eigen::Vector3f point;
    Eigen::Vector3f left;
    Eigen::Vector3f right;
    Eigen::Vector3f above;
    Eigen::Vector3f below;
    if (sampled[i].depth_m > 0.0F && point_at(u, v, point) && point_at(u - reach, v, left) && point_at(u + reach, v, right) &&
        point_at(u, v - reach, above) && point_at(u, v + reach, below)) {
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
    surfaces[i] = surface;
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

/// Aligns one candidate: each sample is drawn along its normal to the weighted mean of the remembered points around it.
template <class Executor>
struct AlignWithPoints {
  LeafReservoirsView reservoirs;
  int num_trees;
  std::size_t pool_size;
  const std::uint32_t* leaves;
  const SurfaceSample* surfaces;
  int num_samples;
  int num_iterations;
  float first_radius_m;
  float last_radius_m;
  const std::uint64_t* order;
  SE3* hypotheses;
  float* misfits;  ///< per slot: 0 if every sample lies on the remembered surface, 1 if none has any of it around

  FOOTHOLD_HD void operator()(const typename Executor::Team& team, NoScratch&, std::size_t slot) const {
    const std::uint32_t hypothesis = hypothesis_of(order[slot]);
    SE3 pose = hypotheses[hypothesis];
    float fit = 0.0F;
    for (int iteration = 0; iteration < num_iterations; ++iteration) {
      const float progress = num_iterations > 1 ? static_cast<float>(iteration) / static_cast<float>(num_iterations - 1) : 1.0F;
      const float radius_mm = 1000.0F * (first_radius_m + (last_radius_m - first_radius_m) * progress);
      float sums[kNumAlignmentSums] = {};
      const int num_used = 2 * iteration < num_iterations ? num_samples / 3 : num_samples;  // few samples suffice at first
      for (int i = team.lane(); i < num_used; i += team.size()) add_sample(pose, static_cast<std::size_t>(i), radius_mm, sums);
      team.sum_all(sums, kNumAlignmentSums);
      fit = sums[kFit] / (sums[kNumWithSurface] > 0.0F ? sums[kNumWithSurface] : 1.0F);
      float twist[6];
      if (sums[kNumSupported] < kMinSupported || !solve_damped(sums, kDamping, twist)) break;
      pose = perturbed(pose, twist);
    }
    team.sync();
    if (team.lane() != 0) return;
    hypotheses[hypothesis] = pose;
    misfits[slot] = 1.0F - fit;
  }

 private:
  // Behind the Hessian and the gradient of solve_damped():
  static constexpr int kNumSupported = kNumHessian + 6;  ///< samples with remembered points around them
  static constexpr int kNumWithSurface = kNumSupported + 1;
  static constexpr int kFit = kNumSupported + 2;
  static constexpr int kNumAlignmentSums = kNumSupported + 3;
  static constexpr float kMinSupported = 50.0F;  ///< samples below which the alignment is not trusted
  static constexpr float kDamping = 1e-4F;

  FOOTHOLD_HD void add_sample(const SE3& pose, std::size_t i, float radius_mm, float* sums) const {
    const SurfaceSample& surface = surfaces[i];
    const Eigen::Vector3f normal_camera(surface.normal_camera[0], surface.normal_camera[1], surface.normal_camera[2]);
    if (normal_camera.squaredNorm() == 0.0F) return;
    sums[kNumWithSurface] += 1.0F;
    const Eigen::Vector3f q = pose.rotation * Eigen::Vector3f(surface.point_camera[0], surface.point_camera[1], surface.point_camera[2]);
    const Eigen::Vector3f n = pose.rotation * normal_camera;
    const Eigen::Vector3f p_mm = (q + pose.translation) * 1000.0F;
    float weight = 0.0F;
    float offset = 0.0F;
    for (int tree = 0; tree < num_trees; ++tree) {
      const std::uint32_t leaf = leaves[static_cast<std::size_t>(tree) * pool_size + i];
      if (leaf < static_cast<std::uint32_t>(reservoirs.num_leaves)) add_leaf(leaf, p_mm, n, radius_mm, weight, offset);
    }
    if (weight < kMinWeight) return;
    const float residual = offset / weight * 1e-3F;  // along the normal, from the sample to the remembered surface [m]
    const Eigen::Vector3f moment = cross_product(q, n);
    const float j[6] = {moment.x(), moment.y(), moment.z(), n.x(), n.y(), n.z()};
    int next = 0;
    for (int a = 0; a < 6; ++a) {
      for (int b = a; b < 6; ++b) sums[next++] += j[a] * j[b];
    }
    for (int a = 0; a < 6; ++a) sums[kNumHessian + a] -= j[a] * residual;
    sums[kNumSupported] += 1.0F;
    const float distance = std::fabs(residual) * 1000.0F / radius_mm;
    sums[kFit] += distance < 1.0F ? 1.0F - distance : 0.0F;
  }

  static constexpr float kMinWeight = 0.5F;  ///< one remembered point nearby

  /// Adds a leaf's points within the radius, weighted by (1 - d^2 / r^2)^2.
  FOOTHOLD_HD FOOTHOLD_INLINE void add_leaf(std::uint32_t leaf, const Eigen::Vector3f& p_mm, const Eigen::Vector3f& n, float radius_mm,
                                            float& weight, float& offset) const {
    const int num_points = reservoirs.num_stored(leaf);
    const float inverse_radius2 = 1.0F / (radius_mm * radius_mm);
    float weights[kReservoirBlockSize] = {};
    float offsets[kReservoirBlockSize] = {};
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
        offsets[w] += factor * (n.x() * dx + n.y() * dy + n.z() * dz);
      }
    }
    for (int w = 0; w < kReservoirBlockSize; ++w) {
      weight += weights[w];
      offset += offsets[w];
    }
  }
};

}  // namespace foothold

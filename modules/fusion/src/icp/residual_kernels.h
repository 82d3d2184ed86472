// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// The normal equations of one step of alignment, summed over pixels.
#pragma once

#include "icp/icp_state.h"

namespace foothold {

/// Everything that a step at one level needs.
struct IcpStep {
  DepthLevel live;
  const SurfacePixel* models;  ///< one rendering after another
  Intrinsics model_intrinsics;
  int model_width;
  int model_height;
  const float* live_greys;       ///< like model_greys nullptr where depth alone is compared
  const GreyPixel* model_greys;  ///< one rendering after another
  float outlier_m;
  DepthRange range;
};

/// Sums the normal equations of one alignment over one chunk of pixels; kWidth pixels of a row side by side.
template <int kWidth, IcpResiduals kResiduals>
struct SumChunk {
  static constexpr int kGroupsPerChunk = 512 / kWidth;
  static constexpr int kNumSums = num_sums_of(kResiduals);

  IcpStep step;
  int num_chunks;
  const IcpState* states;
  float* chunk_sums;

  template <class Team>
  FOOTHOLD_HD void operator()(const Team& team, std::size_t item) const {
    const int alignment = static_cast<int>(item) / num_chunks;
    const int chunk = static_cast<int>(item) % num_chunks;
    const IcpState& state = states[alignment];
    if (state.converged != 0) return;
    const std::size_t first_pixel =
        static_cast<std::size_t>(alignment) * static_cast<std::size_t>(step.model_width) * static_cast<std::size_t>(step.model_height);
    const SurfacePixel* const model = step.models + first_pixel;
    const int groups_per_row = (step.live.depth.width + kWidth - 1) / kWidth;
    const int num_groups = groups_per_row * step.live.depth.height;
    const int first = chunk * kGroupsPerChunk;
    const SE3 pose = state.trial;
    float sums[kNumSums][kWidth] = {};
    for (int k = team.lane(); k < kGroupsPerChunk; k += team.size()) {
      const int group = first + k;
      if (group >= num_groups) continue;
      Points points;
      const int u0 = group % groups_per_row * kWidth;
      const int v = group / groups_per_row;
      project(u0, v, pose, points);
      add_distances(model, points, sums);
      if constexpr (kResiduals == IcpResiduals::kDepthAndGrey) {
        add_greys(model, step.model_greys + first_pixel, u0, v, state.trial_offset, points, sums);
      }
    }
    float totals[kNumSums];
    for (int j = 0; j < kNumSums; ++j) {
      totals[j] = 0.0F;
      for (int i = 0; i < kWidth; ++i) totals[j] += sums[j][i];
    }
    team.sum_all(totals);
    for (int j = team.lane(); j < kNumSums; j += team.size()) chunk_sums[item * kNumSums + static_cast<std::size_t>(j)] = totals[j];
  }

 private:
  /// The live points of a group in the model camera's frame, and the pixels of the rendering where they land.
  struct Points {
    float x[kWidth];
    float y[kWidth];
    float z[kWidth];
    float valid[kWidth];  ///< 1 where the live image has depth
    float scale[kWidth];  ///< growth of the outlier distance with depth
    float noise[kWidth];  ///< growth of the noise with depth
    float u[kWidth];      ///< of the rendering, a whole number
    float v[kWidth];
    float right[kWidth];  ///< of that pixel's centre [px]
    float down[kWidth];
    int pixel[kWidth];  ///< -1 outside the rendering
  };

  FOOTHOLD_HD void add_distances(const SurfacePixel* model, const Points& points, float (&sums)[kNumSums][kWidth]) const {
    float nx[kWidth];
    float ny[kWidth];
    float nz[kWidth];
    float depth[kWidth];
    for (int i = 0; i < kWidth; ++i) {
      const SurfacePixel surface = points.pixel[i] >= 0 ? model[points.pixel[i]] : SurfacePixel{};
      nx[i] = surface.normal_x;
      ny[i] = surface.normal_y;
      nz[i] = surface.normal_z;
      depth[i] = surface.depth_m;
    }
    accumulate(points, nx, ny, nz, depth, sums);
  }

  FOOTHOLD_HD void project(int u0, int v, const SE3& pose, Points& points) const {
    const Intrinsics& k = step.live.intrinsics;
    const int width = step.live.depth.width;
    const float* const row = step.live.depth.data + static_cast<std::size_t>(v) * static_cast<std::size_t>(width);
    const Eigen::Matrix3f& r = pose.rotation;
    const Eigen::Vector3f& t = pose.translation;
    const float y_ray = (static_cast<float>(v) - k.cy) / k.fy;
    const float inverse_fx = 1.0F / k.fx;
    const float right = static_cast<float>(step.model_width) - 0.5F;
    const float bottom = static_cast<float>(step.model_height) - 0.5F;
    float live[kWidth];
    for (int i = 0; i < kWidth; ++i) live[i] = u0 + i < width ? row[u0 + i] : 0.0F;
    for (int i = 0; i < kWidth; ++i) {
      const bool valid = (live[i] >= step.range.min_m) & (live[i] <= step.range.max_m);
      const float z = valid ? live[i] : 0.0F;
      const float x = (static_cast<float>(u0 + i) - k.cx) * inverse_fx * z;
      const float y = y_ray * z;
      const float qx = r(0, 0) * x + r(0, 1) * y + r(0, 2) * z + t.x();
      const float qy = r(1, 0) * x + r(1, 1) * y + r(1, 2) * z + t.y();
      const float qz = r(2, 0) * x + r(2, 1) * y + r(2, 2) * z + t.z();
      const float inverse = 1.0F / qz;
      const float u = step.model_intrinsics.fx * qx * inverse + step.model_intrinsics.cx;
      const float w = step.model_intrinsics.fy * qy * inverse + step.model_intrinsics.cy;
      const bool inside = valid & (qz > 0.0F) & (u > -0.5F) & (w > -0.5F) & (u < right) & (w < bottom);
      const int column = static_cast<int>((inside ? u : 0.0F) + 0.5F);
      const int line = static_cast<int>((inside ? w : 0.0F) + 0.5F);
      points.x[i] = qx;
      points.y[i] = qy;
      points.z[i] = qz;
      points.valid[i] = valid ? 1.0F : 0.0F;
      points.scale[i] = 1.0F + kOutlierGrowth * z * z;
      points.noise[i] = 1.0F + kNoiseGrowth * z * z;
      points.u[i] = static_cast<float>(column);
      points.v[i] = static_cast<float>(line);
      points.right[i] = inside ? u - static_cast<float>(column) : 0.0F;
      points.down[i] = inside ? w - static_cast<float>(line) : 0.0F;
      points.pixel[i] = inside ? line * step.model_width + column : -1;
    }
  }

  FOOTHOLD_HD void accumulate(const Points& points, const float (&nx)[kWidth], const float (&ny)[kWidth], const float (&nz)[kWidth],
                              const float (&depth)[kWidth], float (&sums)[kNumSums][kWidth]) const {
    const Intrinsics& k = step.model_intrinsics;
    const float inverse_fx = 1.0F / k.fx;
    const float inverse_fy = 1.0F / k.fy;
    float jacobian[6][kWidth];
    float weight[kWidth];
    float residual[kWidth];
    for (int i = 0; i < kWidth; ++i) {
      const float dx = points.x[i] - (points.u[i] - k.cx) * inverse_fx * depth[i];
      const float dy = points.y[i] - (points.v[i] - k.cy) * inverse_fy * depth[i];
      const float dz = points.z[i] - depth[i];
      const float r = nx[i] * dx + ny[i] * dy + nz[i] * dz;
      const float inverse_scale = 1.0F / points.scale[i];
      const float limit = step.outlier_m * points.scale[i];
      const float relative = r * inverse_scale / step.outlier_m;
      const float inside = 1.0F - relative * relative;
      const bool has_normal = nx[i] * nx[i] + ny[i] * ny[i] + nz[i] * nz[i] > 0.5F;
      // A point far along the surface from its partner is as wrong as one far off it: occlusion edges.
      const bool partner = has_normal & (inside > 0.0F) & (dx * dx + dy * dy + dz * dz < kMaxPartnerRatio * limit * limit);
      const float w = partner ? inside * inside : 0.0F;
      weight[i] = w / (points.noise[i] * points.noise[i]);
      residual[i] = partner ? r : 0.0F;
      jacobian[0][i] = points.y[i] * nz[i] - points.z[i] * ny[i];
      jacobian[1][i] = points.z[i] * nx[i] - points.x[i] * nz[i];
      jacobian[2][i] = points.x[i] * ny[i] - points.y[i] * nx[i];
      jacobian[3][i] = nx[i];
      jacobian[4][i] = ny[i];
      jacobian[5][i] = nz[i];
      // Tukey's loss relative to its limit, 1 for an outlier: rho = 1 - (1 - (r/c)^2)^3.
      sums[kCostSum][i] += points.valid[i] * (partner ? 1.0F - inside * inside * inside : 1.0F);
      sums[kInlierSum][i] += partner ? 1.0F : 0.0F;
      sums[kValidSum][i] += points.valid[i];
      sums[kMappedSum][i] += has_normal ? points.valid[i] : 0.0F;
    }
    add_normal_equations(jacobian, weight, residual, sums);
  }

  /// Compares greys where depths agree. A pixel's grey goes on linearly around its centre, so that r and J are smooth.
  FOOTHOLD_HD void add_greys(const SurfacePixel* model, const GreyPixel* model_greys, int u0, int v, float offset, const Points& points,
                             float (&sums)[kNumSums][kWidth]) const {
    const Intrinsics& k = step.model_intrinsics;
    const int width = step.live.depth.width;
    const float* const row = step.live_greys + static_cast<std::size_t>(v) * static_cast<std::size_t>(width);
    float jacobian[6][kWidth];
    float weight[kWidth];
    float residual[kWidth];
    float live[kWidth];
    float depth[kWidth];
    GreyPixel greys[kWidth];
    for (int i = 0; i < kWidth; ++i) {
      live[i] = u0 + i < width ? row[u0 + i] : -1.0F;
      depth[i] = points.pixel[i] >= 0 ? model[points.pixel[i]].depth_m : 0.0F;
      greys[i] = points.pixel[i] >= 0 ? model_greys[points.pixel[i]] : GreyPixel{};
    }
    for (int i = 0; i < kWidth; ++i) {
      const float r = greys[i].grey + greys[i].along_u * points.right[i] + greys[i].along_v * points.down[i] - live[i] - offset;
      const float relative = r * (1.0F / kGreyOutlier);
      const float inside = 1.0F - relative * relative;
      const float apart = points.z[i] - depth[i];
      const bool partner = (live[i] >= 0.0F) & (greys[i].grey >= 0.0F) & (inside > 0.0F) &
                           (apart * apart < kMaxPartnerRatio * step.outlier_m * step.outlier_m * points.scale[i] * points.scale[i]);
      const float inverse = partner ? 1.0F / points.z[i] : 0.0F;
      const float gx = greys[i].along_u * k.fx * inverse;
      const float gy = greys[i].along_v * k.fy * inverse;
      const float gz = -(gx * points.x[i] + gy * points.y[i]) * inverse;
      weight[i] = partner ? inside * inside : 0.0F;
      residual[i] = partner ? r : 0.0F;
      jacobian[0][i] = points.y[i] * gz - points.z[i] * gy;
      jacobian[1][i] = points.z[i] * gx - points.x[i] * gz;
      jacobian[2][i] = points.x[i] * gy - points.y[i] * gx;
      jacobian[3][i] = gx;
      jacobian[4][i] = gy;
      jacobian[5][i] = gz;
      sums[kGreyWeightSum][i] += weight[i];
      sums[kGreyOffsetSum + 6][i] += weight[i] * residual[i];
    }
    for (int a = 0; a < 6; ++a) {
      for (int i = 0; i < kWidth; ++i) sums[kGreyOffsetSum + a][i] += weight[i] * jacobian[a][i];
    }
    add_normal_equations(jacobian, weight, residual, sums + kGreySum);
  }

  /// Adds w J J^T, its upper triangle, and w J r.
  FOOTHOLD_HD static void add_normal_equations(const float (&jacobian)[6][kWidth], const float (&weight)[kWidth],
                                               const float (&residual)[kWidth], float (*sums)[kWidth]) {
    int row = 0;
    for (int a = 0; a < 6; ++a) {
      float weighted[kWidth];
      for (int i = 0; i < kWidth; ++i) weighted[i] = weight[i] * jacobian[a][i];
      for (int b = a; b < 6; ++b, ++row) {
        for (int i = 0; i < kWidth; ++i) sums[row][i] += weighted[i] * jacobian[b][i];
      }
      for (int i = 0; i < kWidth; ++i) sums[kNumHessian + a][i] += weighted[i] * residual[i];
    }
  }

  static constexpr float kMaxPartnerRatio = 9.0F;
};

}  // namespace foothold

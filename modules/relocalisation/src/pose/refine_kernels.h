// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// Refining poses by Levenberg-Marquardt in se(3). Reference: [Cavallari2017] Sec. 2.2.3; [Strasdat2012].
#pragma once

#include <limits>

#include "foothold/base/normal_equations.h"
#include "pose/refine.h"
#include "pose/score_kernels.h"

namespace foothold {

/// Fixes each sample's mode for a round: the nearest by Mahalanobis distance, unless it is further than the radius.
/// nearest[(group * num_samples + sample) * kWidth + lane] is the mode's position among the pixel's modes, or kNoMode.
template <class Executor>
struct AssignModes {
  static constexpr int kWidth = Executor::kVectorWidth;
  static_assert(kLargestGroup % kWidth == 0, "ModeAssignments has room for whole groups");
  CorrespondencePoolView pool;
  HypothesesView hypotheses;
  std::size_t num_active;
  std::uint32_t num_samples;
  float radius_m;
  std::uint16_t* nearest;

  FOOTHOLD_HD void operator()(const typename Executor::Team& team, std::size_t group) const {
    const PoseGroup<kWidth> poses(hypotheses, group * static_cast<std::size_t>(kWidth), num_active);
    std::uint16_t* out = nearest + group * num_samples * static_cast<std::size_t>(kWidth);
    for (std::uint32_t s = static_cast<std::uint32_t>(team.lane()); s < num_samples; s += static_cast<std::uint32_t>(team.size())) {
      std::uint16_t* const row = out + s * static_cast<std::uint32_t>(kWidth);
      if (s < *pool.num_pixels) {
        assign_sample(poses, pool.pixels[s], row);
      } else {
        for (int w = 0; w < kWidth; ++w) row[w] = kNoMode;
      }
    }
  }

 private:
  FOOTHOLD_HD FOOTHOLD_INLINE void assign_sample(const PoseGroup<kWidth>& poses, const PooledPixel& pixel, std::uint16_t* row) const {
    float best[kWidth];
    float distance2[kWidth];
    std::int32_t position[kWidth];
    for (int w = 0; w < kWidth; ++w) {
      best[w] = std::numeric_limits<float>::max();
      distance2[w] = std::numeric_limits<float>::max();
      position[w] = kNoMode;
    }
    scan_modes(poses, pool, pixel, [&](int mode, int w, float d2, float mode_distance2) {
      const bool nearer = d2 < best[w];
      best[w] = nearer ? d2 : best[w];
      distance2[w] = nearer ? mode_distance2 : distance2[w];
      position[w] = nearer ? mode : position[w];
    });
    for (int w = 0; w < kWidth; ++w) row[w] = static_cast<std::uint16_t>(distance2[w] < radius_m * radius_m ? position[w] : kNoMode);
  }
};

/// What one pass over the samples adds up: the normal equations and a cost.
inline constexpr int kNumRefinementSums = kNumHessian + 6 + 1;

/// Solves damped normal equations for a twist. @return False if their matrix is not positive definite.
FOOTHOLD_HD inline bool solve_for_twist(const float* sums, float damping, float* twist) {
  constexpr double kSmallestPivot = 1e-9;
  double x[6];
  if (!solve_damped(sums, static_cast<double>(damping), kSmallestPivot, x)) return false;
  for (int k = 0; k < 6; ++k) twist[k] = static_cast<float>(x[k]);
  return true;
}

/// Moves a pose by a twist about the camera's own position, where rotation and translation hardly mix.
FOOTHOLD_HD inline SE3 perturbed(const SE3& pose, const float* twist) {
  Tangent6 tangent;
  for (int k = 0; k < 6; ++k) tangent[k] = twist[k];
  const SE3 step = se3_exp(tangent);
  return {step.rotation * pose.rotation, pose.translation + step.translation};
}

/// Refines one hypothesis on its samples' fixed modes.
template <class Executor>
struct RefineHypothesis {
  static constexpr int kWidth = Executor::kVectorWidth;
  CorrespondencePoolView pool;
  HypothesesView hypotheses;
  std::uint32_t num_samples;
  const std::uint16_t* nearest;
  int num_iterations;

  FOOTHOLD_HD void operator()(const typename Executor::Team& team, std::size_t slot) const {
    SE3& hypothesis = hypotheses.pose_at(slot);
    const std::uint16_t* assigned = nearest + slot / kWidth * num_samples * static_cast<std::size_t>(kWidth) + slot % kWidth;
    SE3 best = hypothesis;
    SE3 trial = best;
    float best_sums[kNumRefinementSums];
    best_sums[kNumRefinementSums - 1] = std::numeric_limits<float>::max();
    float lambda = 1e-3F;
    for (int iteration = 0; iteration < num_iterations; ++iteration) {
      float sums[kNumRefinementSums];
      accumulate(team, trial, assigned, sums);
      if (sums[kNumRefinementSums - 1] <= best_sums[kNumRefinementSums - 1]) {
        for (int k = 0; k < kNumRefinementSums; ++k) best_sums[k] = sums[k];
        best = trial;
        lambda *= 0.1F;
      } else {
        lambda *= 100.0F;
      }
      float twist[6];
      if (!solve_for_twist(best_sums, lambda, twist)) break;
      trial = perturbed(best, twist);
    }
    team.sync();
    if (team.lane() == 0) hypothesis = best;
  }

 private:
  /// Cost, gradient and Gauss-Newton Hessian of sum rho(r' P r), rho(q) = 2 (sqrt(1 + q) - 1): quadratic near a mode, linear far from it.
  FOOTHOLD_HD void accumulate(const typename Executor::Team& team, const SE3& pose, const std::uint16_t* assigned,
                              float (&sums)[kNumRefinementSums]) const {
    float acc[kNumRefinementSums][kWidth] = {};
    for (std::uint32_t first = static_cast<std::uint32_t>(team.lane() * kWidth); first < num_samples;
         first += static_cast<std::uint32_t>(team.size() * kWidth)) {
      float point[3][kWidth];
      float mean[3][kWidth];
      float precision[6][kWidth];
      load(first, assigned, point, mean, precision);
      add_samples(pose, point, mean, precision, acc);
    }
    for (int k = 0; k < kNumRefinementSums; ++k) {
      sums[k] = 0.0F;
      for (int w = 0; w < kWidth; ++w) sums[k] += acc[k][w];
    }
    team.sum_all(sums);
  }

  FOOTHOLD_HD FOOTHOLD_INLINE void load(std::uint32_t first, const std::uint16_t* assigned, float (&point)[3][kWidth],
                                        float (&mean)[3][kWidth], float (&precision)[6][kWidth]) const {
    for (int w = 0; w < kWidth; ++w) {
      const std::uint32_t s = first + static_cast<std::uint32_t>(w);
      const std::uint16_t position = s < num_samples ? assigned[s * static_cast<std::uint32_t>(kWidth)] : kNoMode;
      if (position == kNoMode) {  // a precision of zero makes the sample count for nothing
        for (int k = 0; k < 3; ++k) point[k][w] = mean[k][w] = 0.0F;
        for (int k = 0; k < 6; ++k) precision[k][w] = 0.0F;
        continue;
      }
      const PooledPixel& pixel = pool.pixels[s];
      const Mode& mode = pool.modes[pixel.first_mode + position];
      for (int k = 0; k < 3; ++k) point[k][w] = pixel.point_camera[k];
      for (int k = 0; k < 3; ++k) mean[k][w] = mode.mean_m[k];
      for (int k = 0; k < 6; ++k) precision[k][w] = mode.precision[k];
    }
  }

  FOOTHOLD_HD FOOTHOLD_INLINE void add_samples(const SE3& pose, const float (&point)[3][kWidth], const float (&mean)[3][kWidth],
                                               const float (&precision)[6][kWidth], float (&acc)[kNumRefinementSums][kWidth]) const {
    const Eigen::Matrix3f& r = pose.rotation;
    const Eigen::Vector3f& t = pose.translation;
    for (int w = 0; w < kWidth; ++w) {
      // q = R x: the point seen from the camera's position. Jacobian of a twist there: [-[q]x, I].
      const float qx = r(0, 0) * point[0][w] + r(0, 1) * point[1][w] + r(0, 2) * point[2][w];
      const float qy = r(1, 0) * point[0][w] + r(1, 1) * point[1][w] + r(1, 2) * point[2][w];
      const float qz = r(2, 0) * point[0][w] + r(2, 1) * point[1][w] + r(2, 2) * point[2][w];
      const float ex = qx + t[0] - mean[0][w];
      const float ey = qy + t[1] - mean[1][w];
      const float ez = qz + t[2] - mean[2][w];
      const float gx = precision[0][w] * ex + precision[1][w] * ey + precision[2][w] * ez;
      const float gy = precision[1][w] * ex + precision[3][w] * ey + precision[4][w] * ez;
      const float gz = precision[2][w] * ex + precision[4][w] * ey + precision[5][w] * ez;
      const float root = std::sqrt(1.0F + (ex * gx + ey * gy + ez * gz));
      const float weight = 1.0F / root;  // rho'
      const float pxx = weight * precision[0][w];
      const float pxy = weight * precision[1][w];
      const float pxz = weight * precision[2][w];
      const float pyy = weight * precision[3][w];
      const float pyz = weight * precision[4][w];
      const float pzz = weight * precision[5][w];
      // M = [q]x P, the rotation-translation block; [q]x P [q]x' the rotation block.
      const float mxx = qy * pxz - qz * pxy, mxy = qy * pyz - qz * pyy, mxz = qy * pzz - qz * pyz;
      const float myx = qz * pxx - qx * pxz, myy = qz * pxy - qx * pyz, myz = qz * pxz - qx * pzz;
      const float mzx = qx * pxy - qy * pxx, mzy = qx * pyy - qy * pxy, mzz = qx * pyz - qy * pxz;
      acc[0][w] += qy * mxz - qz * mxy;
      acc[1][w] += qz * mxx - qx * mxz;
      acc[2][w] += qx * mxy - qy * mxx;
      acc[3][w] += mxx;
      acc[4][w] += mxy;
      acc[5][w] += mxz;
      acc[6][w] += qz * myx - qx * myz;
      acc[7][w] += qx * myy - qy * myx;
      acc[8][w] += myx;
      acc[9][w] += myy;
      acc[10][w] += myz;
      acc[11][w] += qx * mzy - qy * mzx;
      acc[12][w] += mzx;
      acc[13][w] += mzy;
      acc[14][w] += mzz;
      acc[15][w] += pxx;
      acc[16][w] += pxy;
      acc[17][w] += pxz;
      acc[18][w] += pyy;
      acc[19][w] += pyz;
      acc[20][w] += pzz;
      acc[21][w] += weight * (qy * gz - qz * gy);
      acc[22][w] += weight * (qz * gx - qx * gz);
      acc[23][w] += weight * (qx * gy - qy * gx);
      acc[24][w] += weight * gx;
      acc[25][w] += weight * gy;
      acc[26][w] += weight * gz;
      acc[27][w] += 2.0F * (root - 1.0F);
    }
  }
};

/// How far hypotheses are refined.
struct Refinement {
  int num_samples;
  int num_iterations;
};

/// Refines the hypotheses in the first slots.
template <class Executor>
void refine(const Executor& executor, const CorrespondencePoolView& pool, const Refinement& how, std::size_t num_active,
            Hypotheses& hypotheses, ModeAssignments& assignments) {
  const auto num_samples = static_cast<std::uint32_t>(how.num_samples);
  executor.for_each_team(num_groups<Executor>(num_active), AssignModes<Executor>{pool, hypotheses.view(), num_active, num_samples,
                                                                                 kRefinementRadiusM, assignments.nearest.data()});
  executor.for_each_team(num_active,
                         RefineHypothesis<Executor>{pool, hypotheses.view(), num_samples, assignments.nearest.data(), how.num_iterations});
}

}  // namespace foothold

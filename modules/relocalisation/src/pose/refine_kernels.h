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
/// nearest[slot * num_samples + sample] is the mode's position among the pixel's modes, or kNoMode.
template <int kWidth>
struct AssignModes {
  CorrespondencePoolView pool;
  HypothesesView hypotheses;
  std::size_t num_active;
  std::uint32_t num_samples;
  float radius_m;
  std::uint16_t* nearest;

  template <class Team>
  FOOTHOLD_HD void operator()(const Team& team, std::size_t group) const {
    const std::size_t first_slot = group * static_cast<std::size_t>(kWidth);
    if (is_alone(hypotheses, num_active) || hypotheses.has_failed(first_slot)) return;
    const PoseGroup<kWidth> poses(hypotheses, first_slot, num_active);
    const int num_rows = num_active - first_slot < kWidth ? static_cast<int>(num_active - first_slot) : kWidth;
    std::uint16_t* const rows = nearest + first_slot * num_samples;
    for (std::uint32_t s = static_cast<std::uint32_t>(team.lane()); s < num_samples; s += static_cast<std::uint32_t>(team.size())) {
      std::uint16_t assigned[kWidth];
      for (int w = 0; w < kWidth; ++w) assigned[w] = kNoMode;
      if (s < *pool.num_pixels) assign_sample(poses, pool.pixels[s], assigned);
      for (int w = 0; w < num_rows; ++w) rows[static_cast<std::uint32_t>(w) * num_samples + s] = assigned[w];
    }
  }

 private:
  FOOTHOLD_HD FOOTHOLD_INLINE void assign_sample(const PoseGroup<kWidth>& poses, const PooledPixel& pixel,
                                                 std::uint16_t (&assigned)[kWidth]) const {
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
    for (int w = 0; w < kWidth; ++w) assigned[w] = static_cast<std::uint16_t>(distance2[w] < radius_m * radius_m ? position[w] : kNoMode);
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

/// Below this a step of refinement is the last: rotation [rad] and translation [m].
inline constexpr float kConvergedTwist = 2e-4F;

/// Refines one hypothesis on its samples' fixed modes.
template <class Executor>
struct RefineHypothesis {
  static constexpr int kWidth = Executor::kVectorWidth;
  /// Where vectors are loaded, samples with a mode are packed one behind another first: they are visited in every step.
  static constexpr bool kPacks = kWidth > 1;
  CorrespondencePoolView pool;
  HypothesesView hypotheses;
  std::size_t num_active;
  std::uint32_t num_samples;
  const std::uint16_t* nearest;
  float* packed;  ///< num_active x kNumPacked x padded num_samples, if packed
  int num_iterations;

  FOOTHOLD_HD void operator()(const typename Executor::Team& team, std::size_t slot) const {
    if (is_alone(hypotheses, num_active) || hypotheses.has_failed(slot)) return;
    SE3& hypothesis = hypotheses.pose_at(slot);
    const std::uint16_t* const assigned = nearest + slot * num_samples;
    const Samples samples = kPacks ? pack(slot, assigned) : Samples{assigned, nullptr, 0, num_samples};
    SE3 best = hypothesis;
    SE3 trial = best;
    float best_sums[kNumRefinementSums];
    best_sums[kNumRefinementSums - 1] = std::numeric_limits<float>::max();
    float lambda = 1e-3F;
    for (int iteration = 0; iteration < num_iterations; ++iteration) {
      float sums[kNumRefinementSums];
      accumulate(team, trial, samples, sums);
      if (sums[kNumRefinementSums - 1] <= best_sums[kNumRefinementSums - 1]) {
        for (int k = 0; k < kNumRefinementSums; ++k) best_sums[k] = sums[k];
        best = trial;
        lambda *= 0.1F;
      } else {
        lambda *= 100.0F;
      }
      float twist[6];
      if (!solve_for_twist(best_sums, lambda, twist) || is_converged(twist)) break;
      trial = perturbed(best, twist);
    }
    team.sync();
    if (team.lane() == 0) hypothesis = best;
  }

 private:
  /// What is summed over: all samples with what they were assigned, or those with a mode, packed.
  struct Samples {
    const std::uint16_t* assigned;
    const float* rows;     ///< point, mean and precision; a row for each number
    std::uint32_t stride;  ///< of rows
    std::uint32_t count;
  };

  FOOTHOLD_HD static bool is_converged(const float (&twist)[6]) {
    float longest = 0.0F;
    for (int k = 0; k < 6; ++k) longest = std::fabs(twist[k]) > longest ? std::fabs(twist[k]) : longest;
    return longest < kConvergedTwist;
  }

  FOOTHOLD_HD Samples pack(std::size_t slot, const std::uint16_t* assigned) const {
    const std::uint32_t stride = padded_samples(num_samples);
    float* const rows = packed + slot * static_cast<std::size_t>(stride) * kNumPacked;
    std::uint32_t count = 0;
    for (std::uint32_t s = 0; s < num_samples; ++s) {
      if (assigned[s] == kNoMode) continue;
      const PooledPixel& pixel = pool.pixels[s];
      const Mode& mode = pool.modes[pixel.first_mode + assigned[s]];
      for (std::uint32_t k = 0; k < 3; ++k) rows[k * stride + count] = pixel.point_camera[k];
      for (std::uint32_t k = 0; k < 3; ++k) rows[(3 + k) * stride + count] = mode.mean_m[k];
      for (std::uint32_t k = 0; k < 6; ++k) rows[(6 + k) * stride + count] = mode.precision[k];
      ++count;
    }
    const std::uint32_t padded = padded_samples(count);
    for (std::uint32_t k = 0; k < kNumPacked; ++k) {  // a precision of zero makes a sample count for nothing
      for (std::uint32_t s = count; s < padded; ++s) rows[k * stride + s] = 0.0F;
    }
    return {assigned, rows, stride, padded};
  }

  /// Cost, gradient and Gauss-Newton Hessian of sum rho(r' P r), rho(q) = 2 (sqrt(1 + q) - 1): quadratic near a mode, linear far from it.
  FOOTHOLD_HD void accumulate(const typename Executor::Team& team, const SE3& pose, const Samples& samples,
                              float (&sums)[kNumRefinementSums]) const {
    float acc[kNumRefinementSums][kWidth] = {};
    for (std::uint32_t first = static_cast<std::uint32_t>(team.lane() * kWidth); first < samples.count;
         first += static_cast<std::uint32_t>(team.size() * kWidth)) {
      float point[3][kWidth];
      float mean[3][kWidth];
      float precision[6][kWidth];
      if constexpr (kPacks) {
        const float* const row = samples.rows + first;
        for (std::uint32_t k = 0; k < 3; ++k) {
          for (std::uint32_t w = 0; w < kWidth; ++w) point[k][w] = row[k * samples.stride + w];
          for (std::uint32_t w = 0; w < kWidth; ++w) mean[k][w] = row[(3 + k) * samples.stride + w];
        }
        for (std::uint32_t k = 0; k < 6; ++k) {
          for (std::uint32_t w = 0; w < kWidth; ++w) precision[k][w] = row[(6 + k) * samples.stride + w];
        }
      } else if (!load(first, samples.assigned[first], point, mean, precision)) {
        continue;
      }
      add_samples(pose, point, mean, precision, acc);
    }
    for (int k = 0; k < kNumRefinementSums; ++k) {
      sums[k] = 0.0F;
      for (int w = 0; w < kWidth; ++w) sums[k] += acc[k][w];
    }
    team.sum_all(sums);
  }

  /// Loads one sample. @return False if it has no mode.
  FOOTHOLD_HD FOOTHOLD_INLINE bool load(std::uint32_t sample, std::uint16_t position, float (&point)[3][kWidth], float (&mean)[3][kWidth],
                                        float (&precision)[6][kWidth]) const {
    if (position == kNoMode) return false;
    const PooledPixel& pixel = pool.pixels[sample];
    const Mode& mode = pool.modes[pixel.first_mode + position];
    for (int k = 0; k < 3; ++k) point[k][0] = pixel.point_camera[k];
    for (int k = 0; k < 3; ++k) mean[k][0] = mode.mean_m[k];
    for (int k = 0; k < 6; ++k) precision[k][0] = mode.precision[k];
    return true;
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

/// Refines the hypotheses in the first slots that have not failed; of several, not if only one of them is left, which has won.
template <class Executor>
void refine(const Executor& executor, const CorrespondencePoolView& pool, const Refinement& how, std::size_t num_active,
            Hypotheses& hypotheses, ModeAssignments& assignments) {
  const auto num_samples = static_cast<std::uint32_t>(how.num_samples);
  std::uint16_t* const nearest = assignments.nearest.data();
  for_each_group(executor, num_active, [&](auto width) {
    return AssignModes<decltype(width)::value>{pool, hypotheses.view(), num_active, num_samples, kRefinementRadiusM, nearest};
  });
  executor.for_each_team(num_active, RefineHypothesis<Executor>{pool, hypotheses.view(), num_active, num_samples, nearest,
                                                                assignments.packed.data(), how.num_iterations});
}

}  // namespace foothold

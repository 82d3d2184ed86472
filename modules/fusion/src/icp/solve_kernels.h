// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// The step that follows from the sums over pixels, and where alignments begin and end.
#pragma once

#include "icp/icp_state.h"

namespace foothold {

/// What the lanes that solve a step share.
struct SolveScratch {
  double sums[kNumSums];
};

/// Combines the chunks' sums of one alignment, each by one lane and in order, accepts or rejects the trial pose, and proposes the next.
struct SolveStep {
  IcpState* states;
  const float* chunk_sums;
  int num_chunks;
  IcpResiduals residuals;
  bool always_accept;  ///< the first of a level, and where greys count: the cost is that of distances alone

  template <class Team>
  FOOTHOLD_HD void operator()(const Team& team, SolveScratch& scratch, std::size_t alignment) const {
    IcpState& state = states[alignment];
    if (state.converged != 0) return;
    const int num_sums = num_sums_of(residuals);
    double(&sums)[kNumSums] = scratch.sums;
    const float* const own_sums = chunk_sums + alignment * static_cast<std::size_t>(num_chunks * num_sums);
    for (int j = team.lane(); j < num_sums; j += team.size()) {
      double sum = 0.0;
      for (int c = 0; c < num_chunks; ++c) sum += static_cast<double>(own_sums[c * num_sums + j]);
      sums[j] = sum;
    }
    team.sync();
    if (team.lane() != 0) return;
    const double num_valid = sums[kValidSum];
    const double cost = num_valid > 0.0 ? sums[kCostSum] / num_valid : 1.0;
    constexpr float kFirstDamping = 1e-4F;
    if (always_accept || cost <= state.cost) {
      state.damping = always_accept ? kFirstDamping : 0.1F * state.damping;
      state.cost = cost;
      state.model_from_camera = state.trial;
      state.offset = state.trial_offset;
      for (int j = 0; j < num_sums; ++j) state.sums[j] = sums[j];
    } else {
      state.damping *= 10.0F;
    }
    propose(state, sums);
  }

 private:
  /// H and J^T r of distances and greys together. The greys' offset b, by which r falls, is eliminated: with s = sum w and v = sum w J,
  /// H - v v^T / s and J^T r - v (sum w r) / s.
  FOOTHOLD_HD static bool join_greys(const double* sums, double* system) {
    for (int j = 0; j < kNumHessian + 6; ++j) system[j] = sums[j];
    const double total = sums[kGreyWeightSum];
    if (!(total > 0.0)) return false;
    const double* const offset = sums + kGreyOffsetSum;
    const auto weight = static_cast<double>(kGreyWeight);
    int row = 0;
    for (int a = 0; a < 6; ++a) {
      for (int b = a; b < 6; ++b, ++row) system[row] += weight * (sums[kGreySum + row] - offset[a] * offset[b] / total);
    }
    for (int a = 0; a < 6; ++a, ++row) system[row] += weight * (sums[kGreySum + row] - offset[a] * offset[6] / total);
    return true;
  }

  /// The offset's part of a step: (sum w r + v . x) / s.
  FOOTHOLD_HD static float offset_step(const double* sums, const double (&step)[6]) {
    double sum = sums[kGreyOffsetSum + 6];
    for (int a = 0; a < 6; ++a) sum += sums[kGreyOffsetSum + a] * step[a];
    return static_cast<float>(sum / sums[kGreyWeightSum]);
  }

  /// @param system  Room for a system of equations: in shared memory, for registers are few.
  FOOTHOLD_HD void propose(IcpState& state, double* system) const {
    double step[6];
    const bool with_greys = residuals == IcpResiduals::kDepthAndGrey;
    const bool has_greys = with_greys && join_greys(state.sums, system);
    if (!solve_damped(with_greys ? system : state.sums, static_cast<double>(state.damping), 0.0, step)) {
      state.converged = 1;
      return;
    }
    Tangent6 tangent = Tangent6::Zero();
    double length = 0.0;
    for (int a = 0; a < 6; ++a) {
      tangent[a] = static_cast<float>(step[a]);
      length += step[a] * step[a];
    }
    state.trial = se3_exp(tangent) * state.model_from_camera;
    state.trial_offset = state.offset + (has_greys ? offset_step(state.sums, step) : 0.0F);
    if (!(length > static_cast<double>(kConvergedStep) * static_cast<double>(kConvergedStep))) state.converged = 1;
  }
};

/// Starts each alignment.
struct BeginIcp {
  const SE3* world_from_models;
  const SE3* guesses;
  IcpState* states;

  FOOTHOLD_HD void operator()(std::size_t i) const {
    states[i].world_from_model = world_from_models[i];
    states[i].model_from_camera = world_from_models[i].inverse() * guesses[i];
    states[i].offset = 0.0F;
  }
};

/// Starts a level from the best poses of the one before.
struct BeginLevel {
  IcpState* states;

  FOOTHOLD_HD void operator()(std::size_t i) const {
    states[i].trial = states[i].model_from_camera;
    states[i].trial_offset = states[i].offset;
    states[i].converged = 0;
  }
};

/// The rotation nearest to a matrix that is one but for rounding, like nearest_rotation() but for kernels, too.
///
/// Newton's iteration X <- X (3 I - X^T X) / 2 squares an error of at most 1e-2 each time. Reference: [Higham1986].
FOOTHOLD_HD inline Eigen::Matrix3f without_rounding_errors(const Eigen::Matrix3f& rotation) {
  constexpr int kNumSteps = 3;
  Eigen::Matrix3d x = rotation.cast<double>();
  for (int i = 0; i < kNumSteps; ++i) {
    const Eigen::Matrix3d square = x.transpose() * x;
    const Eigen::Matrix3d next = 0.5 * (x * (3.0 * Eigen::Matrix3d::Identity() - square));
    x = next;
  }
  return x.cast<float>();
}

/// Says where each alignment ended.
struct EndIcp {
  const IcpState* states;
  SE3* world_from_cameras;

  FOOTHOLD_HD void operator()(std::size_t i) const {
    SE3 pose = states[i].world_from_model * states[i].model_from_camera;
    pose.rotation = without_rounding_errors(pose.rotation);
    world_from_cameras[i] = pose;
  }
};

}  // namespace foothold

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
  bool first_of_level;

  template <class Team>
  FOOTHOLD_HD void operator()(const Team& team, SolveScratch& scratch, std::size_t alignment) const {
    IcpState& state = states[alignment];
    if (state.converged != 0) return;
    double(&sums)[kNumSums] = scratch.sums;
    const float* const own_sums = chunk_sums + alignment * static_cast<std::size_t>(num_chunks * kNumSums);
    for (int j = team.lane(); j < kNumSums; j += team.size()) {
      double sum = 0.0;
      for (int c = 0; c < num_chunks; ++c) sum += static_cast<double>(own_sums[c * kNumSums + j]);
      sums[j] = sum;
    }
    team.sync();
    if (team.lane() != 0) return;
    const double num_valid = sums[kValidSum];
    const double cost = num_valid > 0.0 ? sums[kCostSum] / num_valid : 1.0;
    constexpr float kFirstDamping = 1e-4F;
    if (first_of_level || cost <= state.cost) {
      state.damping = first_of_level ? kFirstDamping : 0.1F * state.damping;
      state.cost = cost;
      state.model_from_camera = state.trial;
      for (int j = 0; j < kNumSums; ++j) state.sums[j] = sums[j];
    } else {
      state.damping *= 10.0F;
    }
    propose(state);
  }

 private:
  FOOTHOLD_HD void propose(IcpState& state) const {
    double step[6];
    if (!solve_damped(state.sums, static_cast<double>(state.damping), 0.0, step)) {
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
  }
};

/// Starts a level from the best poses of the one before.
struct BeginLevel {
  IcpState* states;

  FOOTHOLD_HD void operator()(std::size_t i) const {
    states[i].trial = states[i].model_from_camera;
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

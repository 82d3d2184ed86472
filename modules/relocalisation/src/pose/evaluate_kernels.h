// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// Measuring the final candidates over the whole pool.
#pragma once

#include "pose/candidates.h"
#include "pose/rank.h"
#include "pose/score_kernels.h"

namespace foothold {

/// Measures final candidates over the whole pool.
template <int kWidth>
struct EvaluateCandidates {
  CorrespondencePoolView pool;
  const SampledPixel* sampled;
  std::size_t pool_size;
  HypothesesView hypotheses;
  const SceneAgreement* agreement;  ///< what the scene says about the one in the first slot
  std::size_t num_candidates;
  float truncation;
  PoseCandidate* candidates;

  template <class Team>
  FOOTHOLD_HD void operator()(const Team& team, std::size_t group) const {
    const std::size_t first_slot = group * static_cast<std::size_t>(kWidth);
    const PoseGroup<kWidth> poses(hypotheses, first_slot, num_candidates);
    float num_with_depth = 0.0F;
    for (std::size_t i = static_cast<std::size_t>(team.lane()); i < pool_size; i += static_cast<std::size_t>(team.size())) {
      num_with_depth += sampled[i].depth_m > 0.0F ? 1.0F : 0.0F;
    }
    float sums[3 * kWidth] = {};  // energy, inliers, fine inliers
    for (std::uint32_t s = static_cast<std::uint32_t>(team.lane()); s < *pool.num_pixels; s += static_cast<std::uint32_t>(team.size())) {
      add_sample(poses, pool.pixels[s], sums);
    }
    num_with_depth = team.sum(num_with_depth);
    team.sum_all(sums);
    if (team.lane() != 0) return;
    const float scale = 1.0F / (num_with_depth > 0.0F ? num_with_depth : 1.0F);
    const float num_pixels = static_cast<float>(*pool.num_pixels);
    for (int w = 0; w < kWidth && first_slot + static_cast<std::size_t>(w) < num_candidates; ++w) {
      PoseCandidate& candidate = candidates[first_slot + static_cast<std::size_t>(w)];
      candidate.scene_from_camera = hypotheses.poses[poses.index[w]];
      candidate.mean_energy = (sums[w] + truncation * (num_with_depth - num_pixels)) * scale;
      candidate.inlier_fraction = sums[kWidth + w] * scale;
      candidate.fine_fraction = sums[2 * kWidth + w] * scale;
      candidate.agreement = first_slot + static_cast<std::size_t>(w) == 0 ? *agreement : SceneAgreement{};
      candidate.valid = hypotheses.energies[poses.index[w]] < kFailedEnergy ? 1 : 0;
    }
  }

 private:
  FOOTHOLD_HD FOOTHOLD_INLINE void add_sample(const PoseGroup<kWidth>& poses, const PooledPixel& pixel, float* sums) const {
    float best[kWidth];
    float nearest[kWidth];
    for (int w = 0; w < kWidth; ++w) {
      best[w] = truncation * truncation;
      nearest[w] = 1.0F;
    }
    scan_modes(poses, pool, pixel, [&](int, int w, float d2, float distance2) {
      best[w] = d2 < best[w] ? d2 : best[w];
      nearest[w] = distance2 < nearest[w] ? distance2 : nearest[w];
    });
    for (int w = 0; w < kWidth; ++w) {
      sums[w] += std::sqrt(best[w] > 0.0F ? best[w] : 0.0F);
      sums[kWidth + w] += nearest[w] < kInlierDistanceM * kInlierDistanceM ? 1.0F : 0.0F;
      sums[2 * kWidth + w] += nearest[w] < kFineInlierDistanceM * kFineInlierDistanceM ? 1.0F : 0.0F;
    }
  }
};

}  // namespace foothold

// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// Scoring hypotheses by the paper's energy, and keeping the best. Reference: [Cavallari2017] Sec. 2.2.3, Eq. 4.
#pragma once

#include <cmath>
#include <cstdint>
#include <cstring>

#include "pose/hypothesis_kernels.h"
#include "pose/pose_estimator.h"

namespace foothold {

inline constexpr std::uint16_t kNoMode = 0xffff;

FOOTHOLD_HD inline std::uint32_t hypothesis_of(std::uint64_t key) { return static_cast<std::uint32_t>(key & 0xffffffffU); }

/// A few poses side by side, so that one mode is compared with all of them at once.
template <int kWidth>
struct PoseGroup {
  float r[9][kWidth];
  float t[3][kWidth];
  std::uint32_t index[kWidth];

  /// Loads hypotheses order[first], order[first + 1], ...; past the end, the last one again.
  FOOTHOLD_HD PoseGroup(const SE3* hypotheses, const std::uint64_t* order, std::size_t first, std::size_t num_active) {
    for (int w = 0; w < kWidth; ++w) {
      const std::size_t slot = first + static_cast<std::size_t>(w);
      index[w] = hypothesis_of(order[slot < num_active ? slot : num_active - 1]);
      const SE3& pose = hypotheses[index[w]];
      for (int k = 0; k < 9; ++k) r[k][w] = pose.rotation(k / 3, k % 3);
      for (int k = 0; k < 3; ++k) t[k][w] = pose.translation[k];
    }
  }

  FOOTHOLD_HD FOOTHOLD_INLINE void transform(const PooledPixel& pixel, float* x, float* y, float* z) const {
    const float px = pixel.point_camera[0];
    const float py = pixel.point_camera[1];
    const float pz = pixel.point_camera[2];
    for (int w = 0; w < kWidth; ++w) {
      x[w] = r[0][w] * px + r[1][w] * py + r[2][w] * pz + t[0][w];
      y[w] = r[3][w] * px + r[4][w] * py + r[5][w] * pz + t[1][w];
      z[w] = r[6][w] * px + r[7][w] * py + r[8][w] * pz + t[2][w];
    }
  }
};

/// The squared Mahalanobis distance of a point to a mode.
FOOTHOLD_HD FOOTHOLD_INLINE float squared_mahalanobis(const Mode& mode, float dx, float dy, float dz) {
  const float* p = mode.precision;
  return dx * (p[0] * dx + 2.0F * (p[1] * dy + p[2] * dz)) + dy * (p[3] * dy + 2.0F * (p[4] * dz)) + dz * (p[5] * dz);
}

/// Adds to each hypothesis' energy the samples [first, last): the truncated Mahalanobis distance to the nearest mode.
template <class Executor>
struct ScoreGroup {
  static constexpr int kWidth = Executor::kVectorWidth;
  CorrespondencePoolView pool;
  const SE3* hypotheses;
  const std::uint64_t* order;
  std::size_t num_active;
  std::uint32_t first;
  std::uint32_t last;
  float truncation;
  bool restart;  ///< forget the energies so far, but for those of failed draws
  float* energies;

  FOOTHOLD_HD void operator()(const typename Executor::Team& team, NoScratch&, std::size_t group) const {
    const std::size_t first_slot = group * static_cast<std::size_t>(kWidth);
    const PoseGroup<kWidth> poses(hypotheses, order, first_slot, num_active);
    const std::uint32_t end = last < *pool.num_pixels ? last : *pool.num_pixels;
    float sum[kWidth] = {};
    for (std::uint32_t s = first + static_cast<std::uint32_t>(team.lane()); s < end; s += static_cast<std::uint32_t>(team.size())) {
      add_sample(poses, pool.pixels[s], sum);
    }
    team.sum_all(sum);
    if (team.lane() != 0) return;
    for (int w = 0; w < kWidth && first_slot + static_cast<std::size_t>(w) < num_active; ++w) {
      float& energy = energies[poses.index[w]];
      energy = (restart && energy < kFailedEnergy ? 0.0F : energy) + sum[w];
    }
  }

 private:
  FOOTHOLD_HD FOOTHOLD_INLINE void add_sample(const PoseGroup<kWidth>& poses, const PooledPixel& pixel, float* sum) const {
    float x[kWidth];
    float y[kWidth];
    float z[kWidth];
    float best[kWidth];
    poses.transform(pixel, x, y, z);
    for (int w = 0; w < kWidth; ++w) best[w] = truncation * truncation;
    const Mode* mode = pool.modes + pixel.first_mode;
    for (const Mode* end = mode + pixel.num_modes; mode != end; ++mode) {
      for (int w = 0; w < kWidth; ++w) {
        const float d2 = squared_mahalanobis(*mode, x[w] - mode->mean_m[0], y[w] - mode->mean_m[1], z[w] - mode->mean_m[2]);
        best[w] = d2 < best[w] ? d2 : best[w];
      }
    }
    for (int w = 0; w < kWidth; ++w) sum[w] += std::sqrt(best[w] > 0.0F ? best[w] : 0.0F);
  }
};

/// Sort key of a hypothesis: its energy's bits order as the energy does, since energies are not negative.
struct MakeEnergyKey {
  const float* energies;
  std::uint64_t* order;
  bool first_time;
  FOOTHOLD_HD void operator()(std::size_t i) const {
    const std::uint32_t hypothesis = first_time ? static_cast<std::uint32_t>(i) : hypothesis_of(order[i]);
    std::uint32_t bits = 0;
    memcpy(&bits, &energies[hypothesis], sizeof(bits));
    order[i] = (static_cast<std::uint64_t>(bits) << 32U) | hypothesis;
  }
};

/// Measures final candidates over the whole pool.
template <class Executor>
struct EvaluateCandidates {
  static constexpr int kWidth = Executor::kVectorWidth;
  CorrespondencePoolView pool;
  const SampledPixel* sampled;
  std::size_t pool_size;
  const SE3* hypotheses;
  const float* energies;
  const float* misfits;
  const SceneEvidence* evidence;  ///< per hypothesis
  const std::uint64_t* order;
  std::size_t num_candidates;
  float truncation;
  PoseCandidate* candidates;

  FOOTHOLD_HD void operator()(const typename Executor::Team& team, NoScratch&, std::size_t group) const {
    const std::size_t first_slot = group * static_cast<std::size_t>(kWidth);
    const PoseGroup<kWidth> poses(hypotheses, order, first_slot, num_candidates);
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
      candidate.scene_from_camera = hypotheses[poses.index[w]];
      candidate.mean_energy = (sums[w] + truncation * (num_with_depth - num_pixels)) * scale;
      candidate.inlier_fraction = sums[kWidth + w] * scale;
      candidate.fine_fraction = sums[2 * kWidth + w] * scale;
      candidate.surface_fit = 1.0F - misfits[first_slot + static_cast<std::size_t>(w)];
      candidate.contradicted_fraction = evidence[poses.index[w]].contradicted_fraction();
      candidate.alike_fraction = evidence[poses.index[w]].alike_fraction();
      candidate.valid = energies[poses.index[w]] < kFailedEnergy ? 1 : 0;
    }
  }

 private:
  FOOTHOLD_HD FOOTHOLD_INLINE void add_sample(const PoseGroup<kWidth>& poses, const PooledPixel& pixel, float* sums) const {
    float x[kWidth];
    float y[kWidth];
    float z[kWidth];
    float best[kWidth];
    float nearest[kWidth];
    poses.transform(pixel, x, y, z);
    for (int w = 0; w < kWidth; ++w) {
      best[w] = truncation * truncation;
      nearest[w] = 1.0F;
    }
    const Mode* mode = pool.modes + pixel.first_mode;
    for (const Mode* end = mode + pixel.num_modes; mode != end; ++mode) {
      for (int w = 0; w < kWidth; ++w) {
        const float dx = x[w] - mode->mean_m[0];
        const float dy = y[w] - mode->mean_m[1];
        const float dz = z[w] - mode->mean_m[2];
        const float d2 = squared_mahalanobis(*mode, dx, dy, dz);
        const float distance2 = dx * dx + dy * dy + dz * dz;
        best[w] = d2 < best[w] ? d2 : best[w];
        nearest[w] = distance2 < nearest[w] ? distance2 : nearest[w];
      }
    }
    for (int w = 0; w < kWidth; ++w) {
      sums[w] += std::sqrt(best[w] > 0.0F ? best[w] : 0.0F);
      sums[kWidth + w] += nearest[w] < kInlierDistanceM * kInlierDistanceM ? 1.0F : 0.0F;
      sums[2 * kWidth + w] += nearest[w] < kFineInlierDistanceM * kFineInlierDistanceM ? 1.0F : 0.0F;
    }
  }
};

}  // namespace foothold

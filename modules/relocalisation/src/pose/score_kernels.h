// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// Scoring hypotheses by the paper's energy. Reference: [Cavallari2017] Sec. 2.2.3, Eq. 4.
#pragma once

#include <cmath>
#include <cstdint>
#include <type_traits>

#include "pose/hypotheses.h"
#include "pose/pool.h"

namespace foothold {

/// A few poses side by side, so that one mode is compared with all of them at once.
template <int kWidth>
struct PoseGroup {
  float r[9][kWidth];
  float t[3][kWidth];
  std::uint32_t index[kWidth];

  /// Loads the hypotheses in slots first, first + 1, ...; past the end, the last one again.
  FOOTHOLD_HD PoseGroup(const HypothesesView& hypotheses, std::size_t first, std::size_t num_active) {
    for (int w = 0; w < kWidth; ++w) {
      const std::size_t slot = first + static_cast<std::size_t>(w);
      index[w] = hypotheses.at(slot < num_active ? slot : num_active - 1);
      const SE3& pose = hypotheses.poses[index[w]];
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

/// Compares a pixel with its modes, for each pose of a group: calls visit(mode, w, d2, distance2) with the mode's position among the
/// pixel's, the pose's in the group, and the squared Mahalanobis and Euclidean [m^2] distances from the mode to where the pose puts the
/// pixel.
template <int kWidth, class Visit>
FOOTHOLD_HD FOOTHOLD_INLINE void scan_modes(const PoseGroup<kWidth>& poses, const CorrespondencePoolView& pool, const PooledPixel& pixel,
                                            const Visit& visit) {
  float x[kWidth];
  float y[kWidth];
  float z[kWidth];
  poses.transform(pixel, x, y, z);
  for (int m = 0; m < pixel.num_modes; ++m) {
    const Mode& mode = pool.modes[pixel.first_mode + static_cast<std::uint32_t>(m)];
    for (int w = 0; w < kWidth; ++w) {
      const float dx = x[w] - mode.mean_m[0];
      const float dy = y[w] - mode.mean_m[1];
      const float dz = z[w] - mode.mean_m[2];
      visit(m, w, squared_mahalanobis(mode, dx, dy, dz), dx * dx + dy * dy + dz * dz);
    }
  }
}

/// Adds to each hypothesis' energy the samples [first, last): the truncated Mahalanobis distance to the nearest mode.
template <int kWidth>
struct ScoreGroup {
  CorrespondencePoolView pool;
  HypothesesView hypotheses;
  std::size_t num_active;
  std::uint32_t first;
  std::uint32_t last;
  bool restart;  ///< forget the energies so far, but for those of failed draws
  float truncation;

  template <class Team>
  FOOTHOLD_HD void operator()(const Team& team, std::size_t group) const {
    const std::size_t first_slot = group * static_cast<std::size_t>(kWidth);
    if (hypotheses.has_failed(first_slot)) return;
    const PoseGroup<kWidth> poses(hypotheses, first_slot, num_active);
    const std::uint32_t end = last < *pool.num_pixels ? last : *pool.num_pixels;
    float sum[kWidth] = {};
    for (std::uint32_t s = first + static_cast<std::uint32_t>(team.lane()); s < end; s += static_cast<std::uint32_t>(team.size())) {
      add_sample(poses, pool.pixels[s], sum);
    }
    team.sum_all(sum);
    if (team.lane() != 0) return;
    for (int w = 0; w < kWidth && first_slot + static_cast<std::size_t>(w) < num_active; ++w) {
      float& energy = hypotheses.energies[poses.index[w]];
      energy = (restart && energy < kFailedEnergy ? 0.0F : energy) + sum[w];
    }
  }

 private:
  FOOTHOLD_HD FOOTHOLD_INLINE void add_sample(const PoseGroup<kWidth>& poses, const PooledPixel& pixel, float* sum) const {
    float best[kWidth];
    for (int w = 0; w < kWidth; ++w) best[w] = truncation * truncation;
    scan_modes(poses, pool, pixel, [&](int, int w, float d2, float) { best[w] = d2 < best[w] ? d2 : best[w]; });
    for (int w = 0; w < kWidth; ++w) sum[w] += std::sqrt(best[w] > 0.0F ? best[w] : 0.0F);
  }
};

/// Runs the body that make_body(width) returns, over hypotheses in groups of that width: few are not padded to a whole vector.
template <class Executor, class MakeBody>
void for_each_group(const Executor& executor, std::size_t num_hypotheses, const MakeBody& make_body) {
  constexpr int kWidest = Executor::kVectorWidth;
  const auto run = [&](auto width) {
    constexpr std::size_t kWidth = decltype(width)::value;
    executor.for_each_team((num_hypotheses + kWidth - 1) / kWidth, make_body(width));
  };
  if constexpr (kWidest > 1) {
    if (num_hypotheses == 1) return run(std::integral_constant<int, 1>{});
    if (num_hypotheses <= kWidest / 2) return run(std::integral_constant<int, kWidest / 2>{});
  }
  run(std::integral_constant<int, kWidest>{});
}

/// Samples of the pool by which hypotheses are scored.
struct ScoredSamples {
  int first;
  int last;
  bool restart;  ///< forget the energies so far
};

template <class Executor>
void score(const Executor& executor, const CorrespondencePoolView& pool, const ScoredSamples& samples, float truncation,
           std::size_t num_active, Hypotheses& hypotheses) {
  for_each_group(executor, num_active, [&](auto width) {
    return ScoreGroup<decltype(width)::value>{pool,
                                              hypotheses.view(),
                                              num_active,
                                              static_cast<std::uint32_t>(samples.first),
                                              static_cast<std::uint32_t>(samples.last),
                                              samples.restart,
                                              truncation};
  });
}

}  // namespace foothold

// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// Ranking the last candidates by points of the whole scene. Energies compare a frame's pixels with their own leaves only, so they cannot
/// tell apart places that look alike; but from a wrong place, the camera sees through surfaces that the scene remembers. Not in the paper:
/// its counterpart in the authors' later work is ranking by a rendered model, which a relocaliser does not have.
#pragma once

#include <cmath>
#include <cstring>

#include "foothold/base/exec/prefetch.h"
#include "foothold/base/random.h"
#include "pose/hypothesis_kernels.h"
#include "pose/pose_query.h"
#include "pose/rank.h"
#include "reservoirs/leaf_reservoirs_kernels.h"

namespace foothold {

/// Draws a few points, each from a random leaf, side by side so that their memory accesses overlap; one that is not valid if the leaves
/// asked remember nothing.
template <int kWidth>
struct DrawRememberedPoints {
  LeafReservoirsView reservoirs;
  std::uint64_t seed;
  std::size_t num_points;
  RememberedPoint* points;

  FOOTHOLD_HD void operator()(std::size_t group) const {
    const std::size_t first = group * static_cast<std::size_t>(kWidth);
    const int num = num_points - first < static_cast<std::size_t>(kWidth) ? static_cast<int>(num_points - first) : kWidth;
    std::uint32_t leaf[kWidth];
    int position[kWidth];  // -1 if nothing was found
    for (int w = 0; w < num; ++w) {
      position[w] = draw(first + static_cast<std::size_t>(w), leaf[w]);
      if (position[w] >= 0) prefetch(reservoirs.blocks.place_of(leaf[w], position[w] / kReservoirBlockSize));
    }
    if constexpr (kWidth > 1) {
      for (int w = 0; w < num; ++w) {
        if (position[w] >= 0) prefetch_point(leaf[w], position[w]);
      }
    }
    for (int w = 0; w < num; ++w)
      points[first + static_cast<std::size_t>(w)] = position[w] >= 0 ? remembered(leaf[w], position[w]) : RememberedPoint{};
  }

 private:
  /// @return The position of a point in the drawn leaf; -1 if the leaves asked remember nothing.
  FOOTHOLD_HD int draw(std::size_t i, std::uint32_t& leaf) const {
    constexpr int kTries = 8;
    Random random(seed, i);
    for (int k = 0; k < kTries; ++k) {
      leaf = random.below(static_cast<std::uint32_t>(reservoirs.num_leaves));
      const int num_stored = reservoirs.num_stored(leaf);
      if (num_stored > 0) return static_cast<int>(random.below(static_cast<std::uint32_t>(num_stored)));
    }
    return -1;
  }

  FOOTHOLD_HD void prefetch_point(std::uint32_t leaf, int position) const {
    const ReservoirBlock& block = reservoirs.block_of(leaf, position);
    prefetch(&block.x_mm);
    prefetch(&block.z_mm);
  }

  FOOTHOLD_HD RememberedPoint remembered(std::uint32_t leaf, int position) const {
    const ReservoirPoint point = reservoirs.point(leaf, position);
    return {{static_cast<float>(point.x_mm) * 1e-3F, static_cast<float>(point.y_mm) * 1e-3F, static_cast<float>(point.z_mm) * 1e-3F},
            {static_cast<std::uint8_t>(red_of(point.rgb565)), static_cast<std::uint8_t>(green_of(point.rgb565)),
             static_cast<std::uint8_t>(blue_of(point.rgb565))},
            1};
  }
};

/// How a remembered point relates to the frame.
enum class PointState { kOutOfView, kAgrees, kContradicted, kHidden };

struct PointSighting {
  PointState state;
  int pixel;  ///< of the averaged image, that it projects to
};

/// Looks for a point, given in the camera, among the nine pixels around the one that it projects to: in front of all of them it is seen
/// through, behind all of them it is hidden.
FOOTHOLD_HD FOOTHOLD_INLINE PointSighting sight(const FeatureImageView& image, const Intrinsics& intrinsics,
                                                const Eigen::Vector3f& point_camera) {
  constexpr float kNearestM = 0.3F;
  constexpr float kFurthestM = 6.0F;
  constexpr float kToleranceM = 0.04F;            // (T) of the unaligned poses that are judged
  constexpr float kToleranceAtOneMetre = 0.005F;  // sensor noise grows with the square of the depth [m]
  const PointSighting out_of_view{PointState::kOutOfView, 0};
  const float z = point_camera.z();
  if (!(z > kNearestM && z < kFurthestM)) return out_of_view;
  const Eigen::Vector2f position = intrinsics.project(point_camera);
  const auto u = static_cast<int>(std::floor(position.x() + 0.5F));
  const auto v = static_cast<int>(std::floor(position.y() + 0.5F));
  if (u < 1 || v < 1 || u >= image.width - 1 || v >= image.height - 1) return out_of_view;
  const int pixel = v * image.width + u;
  if (image.pixels[pixel].depth_mm() <= 0) return out_of_view;
  int nearest_mm = image.pixels[pixel].depth_mm();
  int furthest_mm = nearest_mm;
  for (int dv = -1; dv <= 1; ++dv) {
    for (int du = -1; du <= 1; ++du) {
      const int depth_mm = image.pixels[pixel + dv * image.width + du].depth_mm();
      if (depth_mm <= 0) continue;
      nearest_mm = depth_mm < nearest_mm ? depth_mm : nearest_mm;
      furthest_mm = depth_mm > furthest_mm ? depth_mm : furthest_mm;
    }
  }
  const float tolerance_m = kToleranceM + kToleranceAtOneMetre * z * z;
  if (z < static_cast<float>(nearest_mm) * 1e-3F - tolerance_m) return {PointState::kContradicted, pixel};
  if (z > static_cast<float>(furthest_mm) * 1e-3F + tolerance_m) return {PointState::kHidden, pixel};
  return {PointState::kAgrees, pixel};
}

FOOTHOLD_HD inline bool is_alike(const FeaturePixel& pixel, const RememberedPoint& point) {
  const std::uint8_t rgb[3] = {static_cast<std::uint8_t>(pixel.r()), static_cast<std::uint8_t>(pixel.g()),
                               static_cast<std::uint8_t>(pixel.b())};
  return colour_difference(rgb, point.rgb) < kMaxColourDifference;
}

/// Projects the points into the frame from each candidate, and counts.
template <class Executor>
struct JudgeCandidates {
  FeatureImageView image;
  Intrinsics intrinsics;  ///< of the averaged image
  const RememberedPoint* points;
  int num_points;
  HypothesesView hypotheses;
  SceneEvidence* evidence;  ///< per hypothesis

  FOOTHOLD_HD void operator()(const typename Executor::Team& team, std::size_t slot) const {
    if (hypotheses.has_failed(slot)) return;
    const std::uint32_t hypothesis = hypotheses.at(slot);
    const Eigen::Matrix3f camera_from_scene = hypotheses.poses[hypothesis].rotation.transpose();
    const Eigen::Vector3f camera_scene = hypotheses.poses[hypothesis].translation;
    float counts[3] = {};
    for (int i = team.lane(); i < num_points; i += team.size()) {
      const RememberedPoint& point = points[i];
      if (point.valid == 0) continue;
      const Eigen::Vector3f point_scene(point.point_scene[0], point.point_scene[1], point.point_scene[2]);
      add_point(camera_from_scene * (point_scene - camera_scene), point, counts);
    }
    team.sum_all(counts);
    if (team.lane() == 0) evidence[hypothesis] = {counts[0], counts[1], counts[2]};
  }

 private:
  FOOTHOLD_HD FOOTHOLD_INLINE void add_point(const Eigen::Vector3f& point_camera, const RememberedPoint& point, float* counts) const {
    const PointSighting sighting = sight(image, intrinsics, point_camera);
    if (sighting.state == PointState::kOutOfView) return;
    counts[0] += 1.0F;
    counts[1] += sighting.state == PointState::kContradicted ? 1.0F : 0.0F;
    counts[2] += sighting.state == PointState::kAgrees && is_alike(image.pixels[sighting.pixel], point) ? 1.0F : 0.0F;
  }
};

/// Gives each candidate a key that orders the better ones first; of equals, those of lower energy stay first in a stable sort.
struct MakeEvidenceKey {
  const SceneEvidence* evidence;
  HypothesesView hypotheses;

  FOOTHOLD_HD void operator()(std::size_t slot) const {
    const std::uint32_t hypothesis = hypotheses.at(slot);
    const SceneEvidence& found = evidence[hypothesis];
    const float disbelief =
        hypotheses.has_failed(slot) ? kFailedEnergy : 1.0F + found.contradicted_fraction() - found.alike_fraction();  // positive
    std::uint32_t bits = 0;
    memcpy(&bits, &disbelief, sizeof(bits));
    hypotheses.order[slot] = (static_cast<std::uint64_t>(bits) << 32U) | hypothesis;
  }
};

/// Draws the points that candidates are judged by and aligned with, unless they were drawn from this place for the same query.
template <class Executor>
void draw_remembered_points(const Executor& executor, const LeafReservoirsView& reservoirs, std::uint64_t seed, Ranking& ranking) {
  constexpr std::uint64_t kStream = ~std::uint64_t{1};
  constexpr int kWidth = Executor::kVectorWidth;
  if (ranking.drawn_from == reservoirs.num_seen) return;
  ranking.drawn_from = reservoirs.num_seen;
  const std::size_t num_points = ranking.points.size();
  executor.for_each((num_points + kWidth - 1) / kWidth,
                    DrawRememberedPoints<kWidth>{reservoirs, derive_seed(seed, kStream), num_points, ranking.points.data()});
}

/// Confronts the hypotheses in the first slots with the first kRankingPoints points.
template <class Executor>
void judge(const Executor& executor, const PoseQuery& query, std::size_t num_candidates, Hypotheses& hypotheses, Ranking& ranking) {
  executor.for_each_team(num_candidates, JudgeCandidates<Executor>{query.image.view(), query.averaged_intrinsics(), ranking.points.data(),
                                                                   kRankingPoints, hypotheses.view(), ranking.evidence.data()});
}

/// Orders the hypotheses in the first slots by what the points say about them.
template <class Executor>
void rank(const Executor& executor, const PoseQuery& query, std::size_t num_candidates, Hypotheses& hypotheses, Ranking& ranking) {
  judge(executor, query, num_candidates, hypotheses, ranking);
  executor.for_each(num_candidates, MakeEvidenceKey{ranking.evidence.data(), hypotheses.view()});
  executor.sort(Span<std::uint64_t>(hypotheses.order.data(), num_candidates), hypotheses.sort_buffer, 32, 64);
}

}  // namespace foothold

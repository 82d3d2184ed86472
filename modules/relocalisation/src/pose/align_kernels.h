// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// Aligning a pose with the points that the leaves remember, finer than their modes allow. Not in the paper: its counterpart is ICP against
/// a reconstructed model, which a relocaliser does not have. Reference: point-to-plane ICP [Chen1992]; local averages [Levin2003].
#pragma once

#include "foothold/base/exec/prefetch.h"
#include "pose/project_kernels.h"
#include "pose/surface_kernels.h"
#include "reservoirs/leaf_reservoirs_kernels.h"

namespace foothold {

/// Starts the alignment of the best candidate.
struct BeginAlignment {
  HypothesesView hypotheses;
  AlignmentState* state;

  FOOTHOLD_HD void operator()(std::size_t) const { *state = {hypotheses.pose_at(0), 0}; }
};

/// Puts the aligned pose back in its place.
struct EndAlignment {
  const AlignmentState* state;
  HypothesesView hypotheses;

  FOOTHOLD_HD void operator()(std::size_t) const { hypotheses.pose_at(0) = state->scene_from_camera; }
};

/// Looks up the points that leaves remember within reach of a sample, once for all steps: the first kNearPoints of each leaf.
/// Item i is tree i % num_trees of sample i / num_trees. A few items are looked up one after the other, whose points are fetched together.
template <int kWidth>
struct FindNearPoints {
  LeafReservoirsView reservoirs;
  int num_trees;
  PoolPart part;  ///< of which the samples are the first
  const SurfaceSample* surfaces;
  std::size_t num_items;
  float reach_mm;
  const AlignmentState* state;
  NearPoints* near;

  FOOTHOLD_HD void operator()(std::size_t group) const {
    const auto first = static_cast<std::uint32_t>(group) * static_cast<std::uint32_t>(kWidth);
    const auto end = first + kWidth < num_items ? first + kWidth : static_cast<std::uint32_t>(num_items);
    if constexpr (kWidth > 1) {
      for (std::uint32_t i = first; i < end; ++i) prefetch_leaf(leaf_of_item(i));
    }
    for (std::uint32_t i = first; i < end; ++i) {
      near[i].num = 0;
      const std::uint32_t leaf = leaf_of_item(i);
      if (leaf >= static_cast<std::uint32_t>(reservoirs.num_leaves)) continue;
      const SE3& pose = state->scene_from_camera;
      const SurfaceSample& surface = surfaces[i / static_cast<std::uint32_t>(num_trees)];
      find_in_leaf(leaf, (pose.rotation * point_of(surface) + pose.translation) * 1000.0F, near[i]);
    }
  }

 private:
  /// num_leaves for a sample without leaf or normal.
  FOOTHOLD_HD std::uint32_t leaf_of_item(std::uint32_t i) const {
    const std::size_t sample = i / static_cast<std::uint32_t>(num_trees);
    const auto tree = static_cast<int>(i % static_cast<std::uint32_t>(num_trees));
    return has_normal(surfaces[sample]) ? part.leaf(sample, tree) : static_cast<std::uint32_t>(reservoirs.num_leaves);
  }

  FOOTHOLD_HD void prefetch_leaf(std::uint32_t leaf) const {
    if (leaf >= static_cast<std::uint32_t>(reservoirs.num_leaves)) return;
    const int num_points = reservoirs.num_stored(leaf);
    for (int first = 0; first < num_points; first += kReservoirBlockSize) {
      const ReservoirBlock& block = reservoirs.block_of(leaf, first);
      prefetch(&block.x_mm);
      prefetch(&block.z_mm);
    }
  }

  FOOTHOLD_HD FOOTHOLD_INLINE void find_in_leaf(std::uint32_t leaf, const Eigen::Vector3f& p_mm, NearPoints& found) const {
    const int num_points = reservoirs.num_stored(leaf);
    for (int first = 0; first < num_points; first += kReservoirBlockSize) {
      const ReservoirBlock& block = reservoirs.block_of(leaf, first);
      const int num = num_points - first < kReservoirBlockSize ? num_points - first : kReservoirBlockSize;
      std::int32_t is_near[kReservoirBlockSize];
      std::int32_t num_near = 0;
      for (int w = 0; w < kReservoirBlockSize; ++w) {
        const float dx = static_cast<float>(block.x_mm[w]) - p_mm.x();
        const float dy = static_cast<float>(block.y_mm[w]) - p_mm.y();
        const float dz = static_cast<float>(block.z_mm[w]) - p_mm.z();
        is_near[w] = (dx * dx + dy * dy + dz * dz < reach_mm * reach_mm) & (w < num) ? 1 : 0;
        num_near += is_near[w];
      }
      if (num_near == 0) continue;
      for (int w = 0; w < num; ++w) {
        if (is_near[w] == 0) continue;
        if (found.num == kNearPoints) return;
        found.x_mm[found.num] = block.x_mm[w];
        found.y_mm[found.num] = block.y_mm[w];
        found.z_mm[found.num] = block.z_mm[w];
        ++found.num;
      }
    }
  }
};

/// Sums the distances along a sample's normal to the points found near it, weighted by (1 - d^2 / r^2)^2 within the radius.
struct MeasureOffset {
  int num_trees;
  const SurfaceSample* surfaces;
  const NearPoints* near;
  float radius_mm;
  const AlignmentState* state;
  SurfaceOffset* offsets;

  FOOTHOLD_HD void operator()(std::size_t sample) const {
    SurfaceOffset sum{0.0F, 0.0F};
    const SurfaceSample& surface = surfaces[sample];
    if (state->ended == 0 && has_normal(surface)) {
      const SE3& pose = state->scene_from_camera;
      const Eigen::Vector3f p_mm = (pose.rotation * point_of(surface) + pose.translation) * 1000.0F;
      add_points(near + sample * static_cast<std::size_t>(num_trees), p_mm, pose.rotation * normal_of(surface), sum);
    }
    offsets[sample] = sum;
  }

 private:
  FOOTHOLD_HD FOOTHOLD_INLINE void add_points(const NearPoints* of_trees, const Eigen::Vector3f& p_mm, const Eigen::Vector3f& n,
                                              SurfaceOffset& sum) const {
    const float inverse_radius2 = 1.0F / (radius_mm * radius_mm);
    float weights[kNearPoints] = {};
    float products[kNearPoints] = {};
    for (int tree = 0; tree < num_trees; ++tree) {
      const NearPoints& points = of_trees[tree];
      const int num = points.num;
      if (num == 0) continue;
      for (int w = 0; w < kNearPoints; ++w) {
        const float dx = static_cast<float>(points.x_mm[w]) - p_mm.x();
        const float dy = static_cast<float>(points.y_mm[w]) - p_mm.y();
        const float dz = static_cast<float>(points.z_mm[w]) - p_mm.z();
        const float closeness = 1.0F - (dx * dx + dy * dy + dz * dz) * inverse_radius2;
        const float clipped = (closeness > 0.0F) & (w < num) ? closeness : 0.0F;
        weights[w] += clipped * clipped;
        products[w] += clipped * clipped * (n.x() * dx + n.y() * dy + n.z() * dz);
      }
    }
    for (int w = 0; w < kNearPoints; ++w) {
      sum.weight += weights[w];
      sum.offset_mm += products[w];
    }
  }
};

/// One step of the alignment by one team: each sample is drawn along its normal to the mean of the remembered points around it.
template <class Executor>
struct AlignWithPoints {
  const SurfaceSample* surfaces;
  const SurfaceOffset* offsets;
  int num_samples;
  AlignmentState* state;

  FOOTHOLD_HD void operator()(const typename Executor::Team& team, std::size_t) const {
    if (state->ended != 0) return;
    const SE3 pose = state->scene_from_camera;
    float sums[kNumAlignmentSums] = {};
    for (int i = team.lane(); i < num_samples; i += team.size()) add_sample(pose, static_cast<std::size_t>(i), sums);
    team.sum_all(sums);
    if (team.lane() != 0) return;
    float twist[6];
    if (sums[kNumSupported] >= kMinSupported && solve_for_twist(sums, kDamping, twist)) {
      state->scene_from_camera = perturbed(pose, twist);
    } else {
      state->ended = 1;
    }
  }

 private:
  // Behind the Hessian and the gradient:
  static constexpr int kNumSupported = kNumHessian + 6;  ///< samples with remembered points around them
  static constexpr int kNumAlignmentSums = kNumSupported + 1;
  static constexpr float kMinSupported = 50.0F;  ///< samples below which the alignment is not trusted
  static constexpr float kDamping = 1e-4F;
  static constexpr float kMinWeight = 0.5F;  ///< one remembered point nearby

  FOOTHOLD_HD FOOTHOLD_INLINE void add_sample(const SE3& pose, std::size_t i, float (&sums)[kNumAlignmentSums]) const {
    const SurfaceSample& surface = surfaces[i];
    if (!has_normal(surface)) return;
    const SurfaceOffset& sum = offsets[i];
    if (sum.weight < kMinWeight) return;
    const float residual_m = sum.offset_mm / sum.weight * 1e-3F;  // along the normal, from the sample to the remembered surface
    add_point_to_plane(pose.rotation * point_of(surface), pose.rotation * normal_of(surface), residual_m, 1.0F, sums);
    sums[kNumSupported] += 1.0F;
  }
};

/// Estimates the surfaces of the sampled pixels that are aligned.
template <class Executor>
void estimate_surfaces(const Executor& executor, const PoseQuery& query, const CorrespondencePool& pool, Alignment& alignment) {
  executor.for_each(alignment.surfaces.size(),
                    EstimateSurface{surface_estimator(query), query.image.downscale(), pool.sampled.data(), alignment.surfaces.data()});
}

/// Aligns the best hypothesis, first with points of the whole scene where they project into the frame, then, more finely, with the points
/// that its leaves remember. @pre The pool was filled with this forest.
template <class Executor>
class Aligner {
 public:
  Aligner(const Context& context, const PoseQuery& query, const LeafReservoirsView& reservoirs, const ForestView& forest)
      : executor_(context), query_(query), reservoirs_(reservoirs), num_trees_(forest.num_trees) {}

  void run(const CorrespondencePool& pool, const Ranking& ranking, Hypotheses& hypotheses, Alignment& alignment) const {
    AlignmentState* const state = alignment.state.data();
    executor_.for_each(1, BeginAlignment{hypotheses.view(), state});
    project(ranking, state);
    find_near_points(pool, alignment);
    for (int i = 0; i < kLeafSteps; ++i) approach(i, alignment);
    executor_.for_each(1, EndAlignment{state, hypotheses.view()});
  }

 private:
  static constexpr int kProjectionSteps = 4;            ///< (T)
  static constexpr float kProjectionDistanceM = 0.08F;  ///< (T) reach of a projected point
  static constexpr int kLeafSteps = 5;                  ///< (T)
  static constexpr float kFirstReachM = 0.06F;          ///< (T) of a sample, in the first of these steps
  static constexpr float kLastReachM = 0.04F;           ///< (T) in the last
  static constexpr float kLargestMotionM = 0.02F;       ///< (T) of a sample in all of these steps

  void project(const Ranking& ranking, AlignmentState* state) const {
    const DrawnPoints points{Span<const RememberedPoint>(ranking.points)};
    executor_.for_each_team(
        1, AlignByProjection<Executor, DrawnPoints>{surface_estimator(query_), points, kProjectionSteps, kProjectionDistanceM, state});
  }

  void find_near_points(const CorrespondencePool& pool, Alignment& alignment) const {
    constexpr std::size_t kWidth = Executor::kVectorWidth > 1 ? 8 : 1;  // whose points a first-level cache holds
    const std::size_t num_items = alignment.surfaces.size() * static_cast<std::size_t>(num_trees_);
    executor_.for_each((num_items + kWidth - 1) / kWidth,
                       FindNearPoints<kWidth>{reservoirs_, num_trees_, pool.first_part, alignment.surfaces.data(), num_items,
                                              1000.0F * (kFirstReachM + kLargestMotionM), alignment.state.data(), alignment.near.data()});
  }

  void approach(int step, Alignment& alignment) const {
    const auto num_samples = static_cast<int>(alignment.surfaces.size());
    const int num_used = 2 * step < kLeafSteps ? num_samples / 3 : num_samples;  // few samples suffice at first
    const float progress = static_cast<float>(step) / static_cast<float>(kLeafSteps - 1);
    const float radius_m = kFirstReachM + (kLastReachM - kFirstReachM) * progress;
    executor_.for_each(static_cast<std::size_t>(num_used),
                       MeasureOffset{num_trees_, alignment.surfaces.data(), alignment.near.data(), 1000.0F * radius_m,
                                     alignment.state.data(), alignment.offsets.data()});
    executor_.for_each_team(
        1, AlignWithPoints<Executor>{alignment.surfaces.data(), alignment.offsets.data(), num_used, alignment.state.data()});
  }

  Executor executor_;
  const PoseQuery& query_;
  const LeafReservoirsView& reservoirs_;
  int num_trees_;
};

}  // namespace foothold

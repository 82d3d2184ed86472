// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// The algorithm of pose_estimator.h, for both devices. Its steps are in pool_, hypothesis_, score_, refine_, rank_ and align_kernels.h.
#pragma once

#include "pose/align_kernels.h"
#include "pose/hypothesis_kernels.h"
#include "pose/pool_kernels.h"
#include "pose/pose_estimator.h"
#include "pose/project_kernels.h"
#include "pose/rank_kernels.h"
#include "pose/refine_kernels.h"
#include "pose/score_kernels.h"

namespace foothold {

/// What an estimate works on.
struct PoseProblem {
  const Context& context;
  const PoseQuery& query;
  ForestView forest;
  const PoseEstimatorSettings& settings;
};

template <class Executor>
struct PoseAlgorithms {
  static void prepare(const Context& context, const PoseQuery& query, const PoseEstimatorSettings& settings,
                      PoseEstimator::Buffers& buffers);
  static void fill_pool(const PoseProblem& problem, PoseEstimator::Buffers& buffers);
  static void draw_hypotheses(const PoseProblem& problem, PoseEstimator::Buffers& buffers);
  static void count_drawn(const PoseProblem& problem, PoseEstimator::Buffers& buffers, std::size_t roll);
  static void preempt(const PoseProblem& problem, PoseEstimator::Buffers& buffers);
  static void rank(const PoseProblem& problem, PoseEstimator::Buffers& buffers);
  static void finish(const PoseProblem& problem, PoseEstimator::Buffers& buffers);
};

/// The verbs of the pre-emptive loop on one set of hypotheses.
template <class Executor>
class HypothesisSet {
 public:
  HypothesisSet(const PoseProblem& problem, PoseEstimator::Buffers& buffers)
      : executor_(problem.context),
        settings_(problem.settings),
        buffers_(buffers),
        pool_{buffers.pixels.data(), buffers.modes.data(), buffers.slots.data() + settings_.pool_size} {}

  CorrespondencePoolView pool() const { return pool_; }

  void score(std::size_t num_active, int first_sample, int last_sample, bool restart) const {
    executor_.template for_each_team<NoScratch>(
        num_groups(num_active),
        ScoreGroup<Executor>{pool_, buffers_.hypotheses.data(), buffers_.order.data(), num_active, static_cast<std::uint32_t>(first_sample),
                             static_cast<std::uint32_t>(last_sample), settings_.energy_truncation, restart, buffers_.energies.data()});
  }

  /// Orders the first hypotheses by rising energy.
  void sort(std::size_t num_active, bool first_time = false) const {
    executor_.for_each(num_active, MakeEnergyKey{buffers_.energies.data(), buffers_.order.data(), first_time});
    if (!first_time) executor_.sort(Span<std::uint64_t>(buffers_.order.data(), num_active), buffers_.sort_buffer, 32, 64);
  }

  void refine(std::size_t num_active, int num_samples, int num_iterations) const {
    const auto samples = static_cast<std::uint32_t>(num_samples < settings_.pool_size ? num_samples : settings_.pool_size);
    executor_.template for_each_team<NoScratch>(
        num_groups(num_active), AssignModes<Executor>{pool_, buffers_.hypotheses.data(), buffers_.order.data(), num_active, samples,
                                                      settings_.refinement_radius_m, buffers_.nearest.data()});
    executor_.template for_each_team<NoScratch>(
        num_active, RefineHypothesis<Executor>{pool_, buffers_.order.data(), samples, buffers_.nearest.data(), num_iterations,
                                               buffers_.hypotheses.data()});
  }

  static std::size_t num_groups(std::size_t num_active) {
    constexpr std::size_t kWidth = Executor::kVectorWidth;
    return (num_active + kWidth - 1) / kWidth;
  }
  const Executor& executor() const { return executor_; }

 private:
  Executor executor_;
  const PoseEstimatorSettings& settings_;
  PoseEstimator::Buffers& buffers_;
  CorrespondencePoolView pool_;
};

/// The depth camera as if its images were averaged as the query's is.
inline Intrinsics averaged_intrinsics(const PoseQuery& query) {
  return query.frame.calibration.depth.scaled(1.0F / static_cast<float>(query.image.downscale()));
}

/// Estimates surfaces of the averaged image.
inline SurfaceEstimator surface_estimator(const PoseQuery& query) {
  constexpr int kNeighbourDistancePx = 8;  // of a 640 px wide frame, each way
  const int downscale = query.image.downscale();
  const int neighbour_distance = scaled_to_width(kNeighbourDistancePx, query.frame.depth.width);
  const int reach = neighbour_distance > downscale ? neighbour_distance / downscale : 1;
  return {query.image.view(), averaged_intrinsics(query), reach};
}

template <class Executor>
void PoseAlgorithms<Executor>::prepare(const Context& context, const PoseQuery& query, const PoseEstimatorSettings& settings,
                                       PoseEstimator::Buffers& buffers) {
  constexpr std::uint64_t kPoolStream = ~std::uint64_t{0};
  constexpr std::uint64_t kRankingStream = ~std::uint64_t{1};
  const Executor executor(context);
  Random random(settings.seed, kPoolStream);
  const float shift_u = random.uniform();
  executor.for_each(buffers.sampled.size(), SamplePoolPixel{query.frame.depth, shift_u, random.uniform(),
                                                            static_cast<std::uint32_t>(settings.pool_size), buffers.sampled.data()});
  executor.for_each(buffers.remembered.size(),
                    DrawRememberedPoint{query.reservoirs, derive_seed(settings.seed, kRankingStream), buffers.remembered.data()});
  if (settings.alignment_iterations == 0) return;
  executor.for_each(buffers.surfaces.size(),
                    EstimateSurface{surface_estimator(query), query.image.downscale(), buffers.sampled.data(), buffers.surfaces.data()});
}

template <class Executor>
void PoseAlgorithms<Executor>::fill_pool(const PoseProblem& problem, PoseEstimator::Buffers& buffers) {
  const Executor executor(problem.context);
  const PoseQuery& query = problem.query;
  const auto pool_size = static_cast<std::size_t>(problem.settings.pool_size);
  const auto num_leaves = static_cast<std::uint32_t>(problem.forest.num_leaves);
  find_leaves(problem.context, query.image, problem.forest, Span<const SampledPixel>(buffers.sampled.data(), pool_size),
              Span<std::uint32_t>(buffers.leaves.data(), pool_size * static_cast<std::size_t>(problem.forest.num_trees)));
  executor.for_each(pool_size, CountModes{query.leaf_modes, problem.forest.num_trees, num_leaves, pool_size, buffers.leaves.data(),
                                          buffers.mode_counts.data(), buffers.has_modes.data()});
  const auto scan = [&](const Array<std::uint32_t>& counts, Array<std::uint32_t>& sums) {
    executor.exclusive_scan(Span<const std::uint32_t>(counts.data(), pool_size), Span<std::uint32_t>(sums.data(), pool_size + 1));
  };
  scan(buffers.mode_counts, buffers.first_modes);
  scan(buffers.has_modes, buffers.slots);
  executor.for_each(pool_size, GatherPixel{query.frame.calibration.depth, query.image.view(), query.image.downscale(), query.leaf_modes,
                                           problem.forest.num_trees, num_leaves, pool_size, buffers.sampled.data(), buffers.leaves.data(),
                                           buffers.mode_counts.data(), buffers.first_modes.data(), buffers.slots.data(),
                                           buffers.pixels.data(), buffers.modes.data()});
}

template <class Executor>
void PoseAlgorithms<Executor>::draw_hypotheses(const PoseProblem& problem, PoseEstimator::Buffers& buffers) {
  const HypothesisSet<Executor> set(problem, buffers);
  const auto num_hypotheses = static_cast<std::size_t>(problem.settings.num_hypotheses);
  set.executor().template for_each_team<NoScratch>(
      num_hypotheses, DrawHypothesis<Executor>{set.pool(), problem.settings, buffers.hypotheses.data(), buffers.energies.data()});
  set.sort(num_hypotheses, true);
}

template <class Executor>
void PoseAlgorithms<Executor>::count_drawn(const PoseProblem& problem, PoseEstimator::Buffers& buffers, std::size_t roll) {
  Executor(problem.context)
      .template for_each_team<NoScratch>(
          1, CountDrawn<Executor>{buffers.energies.data(), problem.settings.num_hypotheses, buffers.counts.data() + roll});
}

template <class Executor>
void PoseAlgorithms<Executor>::preempt(const PoseProblem& problem, PoseEstimator::Buffers& buffers) {
  const PoseEstimatorSettings& settings = problem.settings;
  const HypothesisSet<Executor> set(problem, buffers);
  auto num_active = static_cast<std::size_t>(settings.num_hypotheses);
  const auto keep = [&](std::size_t count) { num_active = count < num_active ? count : num_active; };

  // The cull.
  set.score(num_active, 0, settings.first_cull_samples, false);
  set.sort(num_active);
  if (settings.first_cull_samples < settings.cull_samples) {
    keep(static_cast<std::size_t>(settings.first_cull_survivors));
    set.score(num_active, settings.first_cull_samples, settings.cull_samples, false);
    set.sort(num_active);
  }
  keep(static_cast<std::size_t>(settings.cull_survivors));

  // Pre-emptive rounds: more samples, better poses, half as many. Losers keep their places behind the winners.
  int num_samples = settings.cull_samples;
  while (num_active > 1) {
    num_samples += settings.round_samples;
    set.refine(num_active, num_samples, settings.refinement_iterations);
    set.score(num_active, 0, num_samples, true);
    set.sort(num_active);
    num_active = num_active / 2;
  }
}

/// Confronts the first candidates with the points drawn by prepare().
template <class Executor>
void judge(const PoseProblem& problem, PoseEstimator::Buffers& buffers, const HypothesisSet<Executor>& set, std::size_t num_candidates) {
  set.executor().template for_each_team<NoScratch>(
      num_candidates, JudgeCandidates<Executor>{problem.query.image.view(), averaged_intrinsics(problem.query), buffers.remembered.data(),
                                                problem.settings.ranking_points, problem.settings.max_colour_difference,
                                                buffers.hypotheses.data(), buffers.order.data(), buffers.evidence.data()});
}

template <class Executor>
void PoseAlgorithms<Executor>::rank(const PoseProblem& problem, PoseEstimator::Buffers& buffers) {
  const HypothesisSet<Executor> set(problem, buffers);
  const std::size_t num_candidates = buffers.candidates.size();
  judge(problem, buffers, set, num_candidates);
  set.executor().for_each(num_candidates, MakeEvidenceKey{buffers.evidence.data(), buffers.energies.data(), buffers.order.data()});
  set.executor().sort(Span<std::uint64_t>(buffers.order.data(), num_candidates), buffers.sort_buffer, 32, 64);
}

/// Aligns the best candidate, first with points of the whole scene where they project into the frame, then, more finely, with the points
/// that its leaves remember. The pool's leaves are those of fill_pool().
template <class Executor>
void align_with_points(const PoseProblem& problem, PoseEstimator::Buffers& buffers, const HypothesisSet<Executor>& set) {
  const PoseEstimatorSettings& settings = problem.settings;
  const auto num_samples = static_cast<int>(buffers.surfaces.size());
  const SurfaceEstimator estimator = surface_estimator(problem.query);
  AlignmentState* const state = buffers.alignment.data();
  set.executor().for_each(1, BeginAlignment{buffers.order.data(), buffers.hypotheses.data(), state});
  const auto num_trees = static_cast<std::size_t>(problem.forest.num_trees);
  for (int i = 0; i < settings.projection_iterations && settings.projection_points > 0; ++i) {
    const float distance_m = settings.projection_distance_m * (2 * i < settings.projection_iterations ? 2.0F : 1.0F);
    set.executor().template for_each_team<NoScratch>(
        1, AlignByProjection<Executor>{estimator, buffers.remembered.data(), settings.projection_points, distance_m, state});
  }
  for (int i = 0; i < settings.alignment_iterations; ++i) {
    const float progress =
        settings.alignment_iterations > 1 ? static_cast<float>(i) / static_cast<float>(settings.alignment_iterations - 1) : 1.0F;
    const float radius_m =
        settings.first_alignment_radius_m + (settings.last_alignment_radius_m - settings.first_alignment_radius_m) * progress;
    const int num_used = 2 * i < settings.alignment_iterations ? num_samples / 3 : num_samples;  // few samples suffice at first
    set.executor().for_each(
        static_cast<std::size_t>(num_used) * num_trees,
        MeasureOffset{problem.query.reservoirs, problem.forest.num_trees, static_cast<std::size_t>(settings.pool_size),
                      buffers.leaves.data(), buffers.surfaces.data(), 1000.0F * radius_m, state, buffers.offsets.data()});
    set.executor().template for_each_team<NoScratch>(
        1, AlignWithPoints<Executor>{problem.forest.num_trees, buffers.surfaces.data(), buffers.offsets.data(), num_used, radius_m, state});
  }
  set.executor().for_each(1, EndAlignment{buffers.order.data(), state, buffers.hypotheses.data(), buffers.misfits.data()});
}

template <class Executor>
void PoseAlgorithms<Executor>::finish(const PoseProblem& problem, PoseEstimator::Buffers& buffers) {
  constexpr int kFinalRounds = 2;  // modes are assigned anew before each
  const PoseEstimatorSettings& settings = problem.settings;
  const HypothesisSet<Executor> set(problem, buffers);
  for (int round = 0; round < kFinalRounds; ++round) set.refine(1, settings.pool_size, settings.final_iterations);
  if (settings.alignment_iterations > 0) align_with_points(problem, buffers, set);
  if (settings.ranking_points > 0) judge(problem, buffers, set, 1);  // once more, where it is now
  const std::size_t num_candidates = buffers.candidates.size();
  set.executor().template for_each_team<NoScratch>(
      set.num_groups(num_candidates),
      EvaluateCandidates<Executor>{set.pool(), buffers.sampled.data(), static_cast<std::size_t>(settings.pool_size),
                                   buffers.hypotheses.data(), buffers.energies.data(), buffers.misfits.data(), buffers.evidence.data(),
                                   buffers.order.data(), num_candidates, settings.energy_truncation, buffers.candidates.data()});
}

}  // namespace foothold

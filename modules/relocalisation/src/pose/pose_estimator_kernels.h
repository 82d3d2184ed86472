// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// The stages of an estimate, one after the other, for both devices. Reference: [Cavallari2017] Sec. 2.2.3.
///
///   pool_kernels.h        pixels and the modes of their leaves
///   hypothesis_kernels.h  triples of pixels make hypotheses
///   score_kernels.h       the energy of a hypothesis
///   refine_kernels.h      Levenberg-Marquardt on a hypothesis
///   rank_kernels.h        beyond the paper: the last candidates judged by points of the whole scene
///   align_kernels.h       beyond the paper: the best candidate aligned with what the scene remembers (surface_, project_kernels.h)
///   confront_kernels.h    beyond the paper: the best candidate confronted with what the scene remembers
///   evaluate_kernels.h    what the candidates explain
///   rejoin_kernels.h      beyond the paper: the best candidate drawn to what the camera that was learnt last saw
#pragma once

#include <algorithm>

#include "pose/align_kernels.h"
#include "pose/confront_kernels.h"
#include "pose/evaluate_kernels.h"
#include "pose/hypothesis_kernels.h"
#include "pose/pool_kernels.h"
#include "pose/pose_estimator.h"
#include "pose/rank_kernels.h"
#include "pose/refine_kernels.h"
#include "pose/rejoin_kernels.h"
#include "pose/score_kernels.h"

namespace foothold {

/// The bodies of PoseEstimator's methods.
template <class Executor>
struct PoseAlgorithms {
  static void prepare(const Context& context, const PoseQuery& query, const SearchPlan& plan, PoseBuffers& buffers);
  static void estimate(const Context& context, const PoseQuery& query, const PlaceView& place, const ForestView& forest,
                       const SearchPlan& plan, PoseBuffers& buffers);

 private:
  static void try_first(const Executor& executor, const SearchPlan& plan, const CorrespondencePoolView& pool, PoseBuffers& buffers);
  static std::size_t cull(const Executor& executor, const SearchPlan& plan, const CorrespondencePoolView& pool, Hypotheses& hypotheses);
  static void preempt(const Executor& executor, const SearchPlan& plan, std::size_t num_active, PoseBuffers& buffers);
};

template <class Executor>
void PoseAlgorithms<Executor>::prepare(const Context& context, const PoseQuery& query, const SearchPlan& plan, PoseBuffers& buffers) {
  const Executor executor(context);
  sample_pool(executor, query, plan.seed, buffers.pool);
  if (plan.confronts_scene) estimate_surfaces(executor, query, buffers.pool, buffers.alignment);
}

template <class Executor>
void PoseAlgorithms<Executor>::estimate(const Context& context, const PoseQuery& query, const PlaceView& place, const ForestView& forest,
                                        const SearchPlan& plan, PoseBuffers& buffers) {
  constexpr int kFinalRounds = 2;  // modes are assigned anew before each
  const Executor executor(context);
  Hypotheses& hypotheses = buffers.hypotheses;
  const std::size_t num_candidates = buffers.candidates.size();
  CorrespondencePool& samples = buffers.pool;
  const auto fill = [&](std::size_t num_samples) {
    const ScopedStage stage(context, "relocalise/correspondences");
    if (num_samples > samples.num_filled) fill_pool<Executor>(context, query, place.leaf_modes, forest, num_samples, samples);
  };
  const auto answer_none = [&] { std::fill(buffers.candidates.data(), buffers.candidates.data() + num_candidates, PoseCandidate{}); };

  samples.num_filled = 0;
  if (query.is_unfamiliar) {
    const std::size_t num_tried = std::min<std::size_t>(kFirstSamples, samples.sampled.size());
    fill(kStopsEarly<Executor> ? num_tried : samples.sampled.size());
    const ScopedStage stage(context, "relocalise/trial");
    try_first(executor, plan, samples.first(num_tried), buffers);
    if (has_given_up<Executor>(hypotheses)) return answer_none();
  }
  fill(samples.sampled.size());
  const CorrespondencePoolView pool = samples.view();
  std::size_t num_active = 0;
  {
    const ScopedStage stage(context, "relocalise/hypotheses");
    draw_hypotheses(executor, pool, plan, query.is_unfamiliar ? hypotheses.given_up.data() : nullptr, hypotheses);
    num_active = cull(executor, plan, pool, hypotheses);
  }
  if (num_active == 0) return answer_none();
  {
    const ScopedStage stage(context, "relocalise/ransac");
    preempt(executor, plan, num_active, buffers);
  }
  if (plan.confronts_scene) {
    const ScopedStage stage(context, "relocalise/rank");
    draw_remembered_points(executor, place.reservoirs, plan.seed, buffers.ranking);
    rank(executor, query, num_candidates, hypotheses, buffers.ranking);
  }
  const ScopedStage stage(context, "relocalise/refine");
  const Refinement final_refinement{plan.pool_size, plan.final_iterations};
  for (int round = 0; round < kFinalRounds; ++round) refine(executor, pool, final_refinement, 1, hypotheses, buffers.assignments);
  if (plan.confronts_scene) {
    Aligner<Executor>(context, query, place.reservoirs, forest).run(buffers.pool, buffers.ranking, hypotheses, buffers.alignment);
    confront(executor, query, num_candidates, hypotheses, buffers.ranking);
  }
  const std::size_t num_evaluated = num_alive<Executor>(hypotheses.view(), num_candidates);
  // What failed is no candidate. On CUDA none is left out: this touches no device memory.
  std::fill(buffers.candidates.data() + num_evaluated, buffers.candidates.data() + num_candidates, PoseCandidate{});
  for_each_group(executor, num_evaluated, [&](auto width) {
    return EvaluateCandidates<decltype(width)::value>{
        pool,          buffers.pool.sampled.data(), buffers.pool.sampled.size(), hypotheses.view(), buffers.ranking.agreement.data(),
        num_evaluated, plan.energy_truncation,      buffers.candidates.data()};
  });
  if (plan.confronts_scene) rejoin(executor, query, place.latest, buffers.alignment, buffers.candidates);
}

/// Finds out by a part of the pool whether hypotheses are worth drawing: draws some, and refines the best few by the samples that they were
/// culled by.
template <class Executor>
void PoseAlgorithms<Executor>::try_first(const Executor& executor, const SearchPlan& plan, const CorrespondencePoolView& pool,
                                         PoseBuffers& buffers) {
  constexpr std::size_t kRefined = 8;  // (T)
  Hypotheses& hypotheses = buffers.hypotheses;
  draw_hypotheses(executor, pool, plan, nullptr, hypotheses);
  const std::size_t num_refined = std::min(kRefined, cull(executor, plan, pool, hypotheses));
  if (num_refined > 0) {
    const int num_samples = std::min(kCullSamples, plan.pool_size);
    refine(executor, pool, {num_samples, plan.round_iterations}, num_refined, hypotheses, buffers.assignments);
    score(executor, pool, {0, num_samples, true}, plan.energy_truncation, num_refined, hypotheses);
    sort_by_energy(executor, num_refined, hypotheses);
  }
  executor.for_each(1, GiveUpHopeless{pool, plan.energy_truncation, hypotheses.view(), hypotheses.given_up.data()});
}

/// Gives up all but the best hypotheses. Those that lose keep their places behind those that win.
/// @return How many are left, where asking costs nothing; as many as may be left elsewhere.
template <class Executor>
std::size_t PoseAlgorithms<Executor>::cull(const Executor& executor, const SearchPlan& plan, const CorrespondencePoolView& pool,
                                           Hypotheses& hypotheses) {
  std::size_t num_active = num_alive<Executor>(hypotheses.view(), hypotheses.poses.size());
  const auto score_and_sort = [&](const ScoredSamples& samples) {
    score(executor, pool, samples, plan.energy_truncation, num_active, hypotheses);
    sort_by_energy(executor, num_active, hypotheses);
  };
  const auto keep = [&](int num_best) { num_active = std::min(num_active, static_cast<std::size_t>(num_best)); };

  score_and_sort({0, plan.first_cull_samples, false});
  if (plan.first_cull_samples < kCullSamples) {
    keep(kFirstCullSurvivors);
    score_and_sort({plan.first_cull_samples, kCullSamples, false});
  }
  keep(plan.cull_survivors);
  if (plan.drops_repeats) {
    executor.for_each(num_active, DropRepeats{hypotheses.view(), kSameHypothesisM, kSameHypothesisRad});
    sort_by_energy(executor, num_active, hypotheses);
  }
  return num_alive<Executor>(hypotheses.view(), num_active);
}

/// Pre-emptive RANSAC: in each round more samples, better poses, fewer of them. Those that lose keep their places behind those that win.
template <class Executor>
void PoseAlgorithms<Executor>::preempt(const Executor& executor, const SearchPlan& plan, std::size_t num_active, PoseBuffers& buffers) {
  const CorrespondencePoolView pool = buffers.pool.view();
  Hypotheses& hypotheses = buffers.hypotheses;
  int num_samples = kCullSamples;
  for (int num_kept = plan.cull_survivors; num_kept > 1; num_kept /= plan.round_divisor) {
    num_active = num_alive<Executor>(hypotheses.view(), std::min(num_active, static_cast<std::size_t>(num_kept)));
    num_samples += plan.round_samples;
    if (num_active <= 1) break;
    refine(executor, pool, {std::min(num_samples, plan.pool_size), plan.round_iterations}, num_active, hypotheses, buffers.assignments);
    if (plan.drops_repeats) executor.for_each(num_active, DropRepeats{hypotheses.view(), kSameRefinedM, kSameRefinedRad});
    score(executor, pool, {0, num_samples, true}, plan.energy_truncation, num_active, hypotheses);
    sort_by_energy(executor, num_active, hypotheses);
  }
}

}  // namespace foothold

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
///   evaluate_kernels.h    what the candidates explain
#pragma once

#include <algorithm>

#include "pose/align_kernels.h"
#include "pose/evaluate_kernels.h"
#include "pose/hypothesis_kernels.h"
#include "pose/pool_kernels.h"
#include "pose/pose_estimator.h"
#include "pose/rank_kernels.h"
#include "pose/refine_kernels.h"
#include "pose/score_kernels.h"

namespace foothold {

/// The bodies of PoseEstimator's methods.
template <class Executor>
struct PoseAlgorithms {
  static void prepare(const Context& context, const PoseQuery& query, const PoseEstimatorSettings& settings, PoseBuffers& buffers);
  /// @param num_drawn  Output: the hypotheses that were drawn, among few.
  static void screen(const Context& context, const PoseQuery& query, const ForestView& forest, const PoseEstimatorSettings& settings,
                     PoseBuffers& buffers, std::uint32_t* num_drawn);
  static void estimate(const Context& context, const PoseQuery& query, const ForestView& forest, const PoseEstimatorSettings& settings,
                       PoseBuffers& buffers);

 private:
  static void preempt(const Executor& executor, const PoseEstimatorSettings& settings, PoseBuffers& buffers);
};

template <class Executor>
void PoseAlgorithms<Executor>::prepare(const Context& context, const PoseQuery& query, const PoseEstimatorSettings& settings,
                                       PoseBuffers& buffers) {
  const Executor executor(context);
  sample_pool(executor, query, settings.seed, buffers.pool);
  draw_remembered_points(executor, query, settings.seed, buffers.ranking);
  if (settings.alignment_iterations > 0) estimate_surfaces(executor, query, buffers.pool, buffers.alignment);
}

template <class Executor>
void PoseAlgorithms<Executor>::screen(const Context& context, const PoseQuery& query, const ForestView& forest,
                                      const PoseEstimatorSettings& settings, PoseBuffers& buffers, std::uint32_t* num_drawn) {
  // (T) In seven rendered rooms rolled by 30 to 90 deg and RedKitchen's halves, leaving out rolls with which none can be drawn loses no
  // answer; a quarter as many hypotheses lose 1 %.
  constexpr int kPixels = 500;
  constexpr int kHypotheses = 256;
  PoseEstimatorSettings few = settings;
  few.pool_size = kPixels < settings.pool_size ? kPixels : settings.pool_size;
  few.num_hypotheses = kHypotheses < settings.num_hypotheses ? kHypotheses : settings.num_hypotheses;
  const Executor executor(context);
  fill_pool<Executor>(context, query, forest, few.pool_size, buffers.pool);
  draw_hypotheses(executor, buffers.pool.view(few.pool_size), few, buffers.hypotheses);
  executor.for_each_team(1, CountDrawn<Executor>{buffers.hypotheses.energies.data(), few.num_hypotheses, num_drawn});
}

template <class Executor>
void PoseAlgorithms<Executor>::estimate(const Context& context, const PoseQuery& query, const ForestView& forest,
                                        const PoseEstimatorSettings& settings, PoseBuffers& buffers) {
  constexpr int kFinalRounds = 2;  // modes are assigned anew before each
  const Executor executor(context);
  const CorrespondencePoolView pool = buffers.pool.view(settings.pool_size);
  Hypotheses& hypotheses = buffers.hypotheses;
  const std::size_t num_candidates = buffers.candidates.size();
  {
    const ScopedStage stage(context, "relocalise/correspondences");
    fill_pool<Executor>(context, query, forest, settings.pool_size, buffers.pool);
  }
  {
    const ScopedStage stage(context, "relocalise/hypotheses");
    draw_hypotheses(executor, pool, settings, hypotheses);
  }
  {
    const ScopedStage stage(context, "relocalise/ransac");
    preempt(executor, settings, buffers);
  }
  if (settings.ranking_points > 0) {
    const ScopedStage stage(context, "relocalise/rank");
    rank(executor, query, settings, num_candidates, hypotheses, buffers.ranking);
  }
  const ScopedStage stage(context, "relocalise/refine");
  const Refinement final_refinement{settings.pool_size, settings.refinement_radius_m, settings.final_iterations};
  for (int round = 0; round < kFinalRounds; ++round) refine(executor, pool, final_refinement, 1, hypotheses, buffers.assignments);
  if (settings.alignment_iterations > 0) {
    Aligner<Executor>(context, query, forest, settings).run(buffers.pool, buffers.ranking, hypotheses, buffers.alignment);
  }
  if (settings.ranking_points > 0) judge(executor, query, settings, 1, hypotheses, buffers.ranking);  // once more, where it is now
  executor.for_each_team(num_groups<Executor>(num_candidates),
                         EvaluateCandidates<Executor>{pool, buffers.pool.sampled.data(), buffers.pool.sampled.size(), hypotheses.view(),
                                                      buffers.alignment.misfits.data(), buffers.ranking.evidence.data(), num_candidates,
                                                      settings.energy_truncation, buffers.candidates.data()});
}

/// Culls, then pre-emptive RANSAC. Those that lose keep their places behind those that win.
template <class Executor>
void PoseAlgorithms<Executor>::preempt(const Executor& executor, const PoseEstimatorSettings& settings, PoseBuffers& buffers) {
  const CorrespondencePoolView pool = buffers.pool.view(settings.pool_size);
  Hypotheses& hypotheses = buffers.hypotheses;
  std::size_t num_active = hypotheses.poses.size();
  const auto score_and_sort = [&](const ScoredSamples& samples) {
    score(executor, pool, samples, settings.energy_truncation, num_active, hypotheses);
    sort_by_energy(executor, num_active, hypotheses);
  };
  const auto keep = [&](int num_best) { num_active = std::min(num_active, static_cast<std::size_t>(num_best)); };

  // The cull, in one or two steps.
  score_and_sort({0, settings.first_cull_samples, false});
  if (settings.first_cull_samples < settings.cull_samples) {
    keep(settings.first_cull_survivors);
    score_and_sort({settings.first_cull_samples, settings.cull_samples, false});
  }
  keep(settings.cull_survivors);

  // The rounds: more samples, better poses, half as many.
  for (int num_samples = settings.cull_samples; num_active > 1; num_active /= 2) {
    num_samples += settings.round_samples;
    refine(executor, pool, {std::min(num_samples, settings.pool_size), settings.refinement_radius_m, settings.refinement_iterations},
           num_active, hypotheses, buffers.assignments);
    score_and_sort({0, num_samples, true});
  }
}

}  // namespace foothold

// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// How a pose is searched for: Foothold's way, or the paper's. Origins (P), (R) and (T) as in settings.h.
#pragma once

#include <cstdint>

#include "foothold/relocalisation/settings.h"

namespace foothold {

/// Samples that score the hypotheses for the cull (P).
inline constexpr int kCullSamples = 500;
/// Hypotheses that survive a first, coarse cull (T).
inline constexpr int kFirstCullSurvivors = 256;
/// Sampled pixels that an unfamiliar view is tried with first, and that the best hypothesis is aligned with (T).
inline constexpr int kFirstSamples = 1200;
/// Share of the highest possible energy, scored by kCullSamples, from which the best hypothesis of that trial is hopeless (T).
inline constexpr float kHopelessEnergy = 0.9935F;

/// Hypotheses nearer to one another than this are one, of which the one that scored best so far is kept: before they are refined, and after
/// (T).
inline constexpr float kSameHypothesisM = 0.10F;
inline constexpr float kSameHypothesisRad = 0.10F;
inline constexpr float kSameRefinedM = 0.03F;
inline constexpr float kSameRefinedRad = 0.03F;

/// What the stages of a search do. The paper's numbers stand in as_published().
struct SearchPlan {
  SearchPlan(const PoseEstimatorSettings& settings, std::uint64_t the_seed)
      : pool_size(settings.pool_size), num_hypotheses(settings.num_hypotheses), num_candidates(settings.num_candidates), seed(the_seed) {
    if (settings.as_published) as_published();
    if (num_candidates > num_hypotheses) num_candidates = num_hypotheses;
  }

  int pool_size;       ///< pixels that are evaluated
  int num_hypotheses;  ///< that are drawn
  int num_candidates;  ///< that are returned
  std::uint64_t seed;

  int max_draws = 100;                 ///< (T) after which a hypothesis is given up
  float max_rigidity_error_m = 0.05F;  ///< (T) largest difference of a distance in the camera to the same distance in the scene
  bool scan_modes = true;              ///< (T) search all modes of a pixel for one that is rigid with the triple so far
  int first_cull_samples = 100;        ///< (T) of kCullSamples, those of the coarse cull; all of them for a single cull
  int cull_survivors = 32;             ///< (T)
  int round_samples = 250;             ///< (T) added in each round of pre-emptive RANSAC
  float energy_truncation = 3.0F;      ///< (T) Mahalanobis distance at which a sample's energy saturates
  int round_iterations = 3;            ///< (T) Levenberg-Marquardt steps of a round
  int final_iterations = 4;            ///< (T) Levenberg-Marquardt steps of the best hypothesis, on the whole pool
  bool drops_repeats = true;           ///< (T) keep one of several hypotheses that are nearly the same
  int round_divisor = 4;               ///< (T) one of so many hypotheses survives a round
  bool confronts_scene = true;         ///< (T) rank the candidates by, and align the best with, points of the whole scene

 private:
  void as_published() {
    max_draws = 6000;               // (R)
    max_rigidity_error_m = 0.025F;  // (R)
    scan_modes = false;             // (P)
    first_cull_samples = kCullSamples;
    cull_survivors = 64;       // (P)
    round_samples = 500;       // (P)
    energy_truncation = 1e6F;  // (P) none
    round_iterations = 10;     // (R)
    final_iterations = 10;     // (R)
    drops_repeats = false;     // (P)
    round_divisor = 2;         // (P)
    confronts_scene = false;   // (P)
  }
};

}  // namespace foothold

// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// Every parameter of the relocaliser. (P) the paper's value, (R) the authors' published code, (M) measured on RedKitchen seq-01 with the
/// prototype that preceded this code and not varied since, (T) tuned here with `relocalisation_benchmark`; where no other runs are named,
/// on RedKitchen seq-01 (gap 30 and halves). The comment names the default; preset("paper") holds (P), then (R).
#pragma once

#include <cstdint>
#include <string>

#include "foothold/base/settings.h"

namespace foothold {

/// The image that features are evaluated on. Reference: [Cavallari2017] Sec. 2.2.1, Eq. 1 and 2.
struct FeatureSettings {
  int downscale = 4;  ///< (P) 1, (M) 4: four times fewer pixels a side, averaged, fit the cache and are no less discriminative

  template <class Visitor>
  static void fields(Visitor& v) {
    v(&FeatureSettings::downscale, "downscale",
      "Factor by which 640 px wide frames are averaged down before features are evaluated; less for narrower frames.", Range{1, 8});
  }
};

/// What leaves remember. Reference: [Cavallari2017] Sec. 2.2.2, steps 1 and 2; [Vitter1985].
struct ReservoirSettings {
  int capacity = 112;       ///< (P) 1024, (T) 112: as accurate, and below 40 MB after 1000 frames of RedKitchen
  int grid_spacing_px = 8;  ///< (P) 4, (M) 8
  bool jitter = true;       ///< (P) false, (M) true: another pixel of each grid cell in every frame

  template <class Visitor>
  static void fields(Visitor& v) {
    v(&ReservoirSettings::capacity, "capacity", "Points that a leaf remembers at most.", Range{16, 1024});
    v(&ReservoirSettings::grid_spacing_px, "grid_spacing_px",
      "Spacing of the pixels that a 640 px wide training frame contributes; less for narrower frames.", Range{1, 640});
    v(&ReservoirSettings::jitter, "jitter", "Take a random pixel of each grid cell instead of its first.");
  }
};

/// How reservoirs become modes. Reference: [Cavallari2017] Sec. 2.2.2, step 3; [Fulkerson2010].
struct ClusteringSettings {
  float sigma_m = 0.1F;               ///< (R)
  float tau_m = 0.05F;                ///< (R)
  int min_cluster_size = 8;           ///< (R) 20, (T) 8
  int max_modes = 10;                 ///< (P)
  float covariance_floor_m = 0.005F;  ///< (T) noise-free planes are singular without it; 0.02 blurs poses
  bool touched_first = true;          ///< (P) false = round robin, (M) true
  int leaves_per_frame = 1024;        ///< (P) 256, (T) 1024: the point budget ends a frame first, once leaves are full
  int point_budget = 16000;           ///< (P) none, (T) 16000

  template <class Visitor>
  static void fields(Visitor& v) {
    v(&ClusteringSettings::sigma_m, "sigma_m", "Standard deviation of the density kernel.", Range{0.001, 10});
    v(&ClusteringSettings::tau_m, "tau_m", "Longest link from a point to its parent of higher density.", Range{0.001, 10});
    v(&ClusteringSettings::min_cluster_size, "min_cluster_size", "Points below which a cluster is dropped.", Range{1, 1024});
    v(&ClusteringSettings::max_modes, "max_modes", "Largest clusters kept per leaf.", Range{1, 64});
    v(&ClusteringSettings::covariance_floor_m, "covariance_floor_m", "Standard deviation added to every mode in all directions.",
      Range{0.0001, 1});
    v(&ClusteringSettings::touched_first, "touched_first", "Cluster the leaves whose contents changed most, instead of round robin.");
    v(&ClusteringSettings::leaves_per_frame, "leaves_per_frame", "Leaves clustered in a frame at most.", Range{1, 65536});
    v(&ClusteringSettings::point_budget, "point_budget",
      "Points clustered in a frame, beyond which no further leaf is begun; 0 for no limit.", Range{0, 1e8});
  }
};

/// How camera-pose hypotheses are drawn, culled and refined. Reference: [Cavallari2017] Sec. 2.2.3.
struct PoseEstimatorSettings {
  int pool_size = 4000;                    ///< (M) the paper evaluates every pixel
  int num_hypotheses = 512;                ///< (P) 1024, (T) 512
  int max_draws = 100;                     ///< (R) 6000, (T) 100: enough when modes are scanned, and views of nowhere end soon
  int max_colour_difference = 30;          ///< (R)
  float min_triple_spread_m = 0.3F;        ///< (P)
  float max_rigidity_error_m = 0.05F;      ///< (R) 0.025, (M) 0.05
  bool scan_modes = true;                  ///< (P) false, (M) true
  int cull_samples = 500;                  ///< (P)
  int first_cull_samples = 100;            ///< (P) none = cull_samples, (M) 100
  int first_cull_survivors = 256;          ///< (M)
  int cull_survivors = 32;                 ///< (P) 64, (T) 32
  int round_samples = 250;                 ///< (P) 500, (M) 250
  float energy_truncation = 3.0F;          ///< (P) none, (T) 3
  float refinement_radius_m = 0.2F;        ///< (R)
  int refinement_iterations = 3;           ///< (T)
  int final_iterations = 4;                ///< (T)
  int alignment_iterations = 5;            ///< (P) 0, (T)
  int alignment_samples = 1200;            ///< (T)
  float first_alignment_radius_m = 0.06F;  ///< (T)
  float last_alignment_radius_m = 0.04F;   ///< (T)
  int ranking_points = 2048;               ///< (P) 0, (T) gap 30: 94.8 to 100 % within 10/10 with 4096, 2048 as good
  int projection_points = 8192;            ///< (P) 0, (T) while projection came last, halves: 4096 lost 4 and 2 points
  int projection_iterations = 4;           ///< (T)
  float projection_distance_m = 0.08F;     ///< (T) halves, every 4th frame: 90.4 and 87.2 % at 0.06, 96.8 and 88.0 here
  int num_candidates = 16;                 ///< (P) the supplement's last 16
  std::uint64_t seed = 42;

  template <class Visitor>
  static void fields(Visitor& v) {
    using S = PoseEstimatorSettings;
    v(&S::pool_size, "pool_size", "Pixels with valid depth that are evaluated; all later samples come from them.", Range{64, 65536});
    v(&S::num_hypotheses, "num_hypotheses", "Hypotheses drawn.", Range{16, 65536});
    v(&S::max_draws, "max_draws", "Draws after which a hypothesis is given up.", Range{1, 1e6});
    v(&S::max_colour_difference, "max_colour_difference", "Largest grey-level difference, in any channel, of a pixel to its mode.",
      Range{1, 255});
    v(&S::min_triple_spread_m, "min_triple_spread_m", "Smallest distance between two scene points of a triple.", Range{0.001, 10});
    v(&S::max_rigidity_error_m, "max_rigidity_error_m", "Largest difference of a distance in the camera to the same distance in the scene.",
      Range{0.0001, 1});
    v(&S::scan_modes, "scan_modes",
      "Search all modes of a pixel for one that is rigid with the triple so far, instead of drawing one blindly.");
    v(&S::cull_samples, "cull_samples", "Samples that score the hypotheses for the cull.", Range{16, 65536});
    v(&S::first_cull_samples, "first_cull_samples", "Of these, samples of a first, coarse cull; equal to cull_samples for a single cull.",
      Range{16, 65536});
    v(&S::first_cull_survivors, "first_cull_survivors", "Hypotheses that survive the coarse cull.", Range{16, 65536});
    v(&S::cull_survivors, "cull_survivors", "Hypotheses that survive the cull.", Range{16, 4096});
    v(&S::round_samples, "round_samples", "Samples added in each round of pre-emptive RANSAC.", Range{1, 65536});
    v(&S::energy_truncation, "energy_truncation", "Mahalanobis distance at which a sample's energy saturates.", Range{0.1, 1e6});
    v(&S::refinement_radius_m, "refinement_radius_m", "Distance to its mode beyond which a sample does not refine a pose.",
      Range{0.001, 10});
    v(&S::refinement_iterations, "refinement_iterations", "Levenberg-Marquardt steps per round.", Range{0, 100});
    v(&S::final_iterations, "final_iterations", "Levenberg-Marquardt steps of the final candidates, on the whole pool.", Range{0, 100});
    v(&S::alignment_iterations, "alignment_iterations", "Steps that align the best pose with the points that leaves remember; 0 for none.",
      Range{0, 100});
    v(&S::alignment_samples, "alignment_samples", "Samples of this alignment.", Range{16, 65536});
    v(&S::first_alignment_radius_m, "first_alignment_radius_m", "Reach of a sample in its first step.", Range{0.001, 1});
    v(&S::last_alignment_radius_m, "last_alignment_radius_m", "Reach of a sample in its last step.", Range{0.001, 1});
    v(&S::ranking_points, "ranking_points",
      "Remembered points that rank the candidates by where the camera sees through them; 0 keeps the order of energies.", Range{0, 65536});
    v(&S::projection_points, "projection_points",
      "Remembered points that the best pose is aligned with where they project into the frame; 0 for none.", Range{0, 1e6});
    v(&S::projection_iterations, "projection_iterations", "Steps of this alignment.", Range{0, 100});
    v(&S::projection_distance_m, "projection_distance_m",
      "Distance of a point from the surface it projects to beyond which it counts nothing; twice that in the first half of the steps.",
      Range{0.001, 1});
    v(&S::num_candidates, "num_candidates", "Candidates returned, best first.", Range{1, 64});
    v(&S::seed, "seed", "Seed of every random choice of a relocalisation.", Range{0, 1.8446744073709552e19});
  }
};

/// The data-free forest: complete trees of random splits. Reference: the authors' random-forest option (R).
struct RandomForestSettings {
  int num_trees = 5;                  ///< (P)
  int depth = 13;                     ///< (M) 8192 leaves a tree, as many as a trained tree has
  int num_features = 256;             ///< (P) half Depth, half DA-RGB
  float min_offset_px_m = 2.0F;       ///< (M)
  float max_offset_px_m = 65.0F;      ///< (M)
  float depth_threshold_mm = 300.0F;  ///< (M)
  float colour_threshold = 25.0F;     ///< (M)
  std::uint64_t seed = 42;

  template <class Visitor>
  static void fields(Visitor& v) {
    using S = RandomForestSettings;
    v(&S::num_trees, "num_trees", "Trees.", Range{1, 32});
    v(&S::depth, "depth", "Splits from root to leaf.", Range{1, 20});
    v(&S::num_features, "num_features", "Features that splits choose from.", Range{2, 65536});
    v(&S::min_offset_px_m, "min_offset_px_m", "Smallest feature offset, in pixels of a 585 px camera times metres.", Range{0, 1000});
    v(&S::max_offset_px_m, "max_offset_px_m", "Largest feature offset, in pixels of a 585 px camera times metres.", Range{0, 1000});
    v(&S::depth_threshold_mm, "depth_threshold_mm", "Scale of the Laplace distribution of depth thresholds.", Range{0, 10000});
    v(&S::colour_threshold, "colour_threshold", "Scale of the Laplace distribution of colour thresholds, in grey levels.", Range{0, 255});
    v(&S::seed, "seed", "Seed of the forest.", Range{0, 1.8446744073709552e19});
  }
};

/// Everything about a ForestRelocaliser but its forest.
struct ForestRelocaliserSettings {
  FeatureSettings features;
  ReservoirSettings reservoirs;
  ClusteringSettings clustering;
  PoseEstimatorSettings pose;
  float acceptance_threshold = 0.9F;  ///< (T) see src/pose/confidence.h
  int num_rolls = 8;                  ///< (P) 1, (T) 8: rendered rooms rolled by 30 to 90 deg
  float sure_confidence = 0.97F;      ///< (T) rolled staircase: 0.9 stops at more wrong steps, 0.99 at no fewer
  std::uint64_t seed = 42;

  template <class Visitor>
  static void fields(Visitor& v) {
    using S = ForestRelocaliserSettings;
    v(&S::features, "features");
    v(&S::reservoirs, "reservoirs");
    v(&S::clustering, "clustering");
    v(&S::pose, "pose");
    v(&S::acceptance_threshold, "acceptance_threshold", "Confidence from which a pose should be believed.", Range{0, 1});
    v(&S::num_rolls, "num_rolls",
      "Rolls of the camera about its optical axis, evenly spaced, that a relocalisation tries at most, upright first.", Range{1, 36});
    v(&S::sure_confidence, "sure_confidence", "Confidence from which no further roll is tried.", Range{0, 1});
    v(&S::seed, "seed", "Seed of every random choice of training.", Range{0, 1.8446744073709552e19});
  }

  /// Named settings: "tuned" (the default) or "paper". @throws InvalidSettings for another name.
  static ForestRelocaliserSettings preset(const std::string& name);

  /// @throws InvalidSettings naming the field, its value and its range.
  void validate() const;
};

}  // namespace foothold

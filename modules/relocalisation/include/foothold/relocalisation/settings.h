// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// What a user of the relocaliser may want to change. (P) is the paper's value, (R) that of the authors' published code, (T) one tuned on
/// RedKitchen seq-01 (gap 30 and halves). preset("paper") holds (P), then (R). What nobody needs to change are constants where they are
/// used.
#pragma once

#include <cstdint>
#include <string>

#include "foothold/base/settings.h"

namespace foothold {

/// The image that features are evaluated on. Reference: [Cavallari2017] Sec. 2.2.1, Eq. 1 and 2.
struct FeatureSettings {
  int downscale = 4;  ///< (P) 1, (T) 4

  /// Shows each field to the visitor, with its name, what it means and its range.
  template <class Visitor>
  static void fields(Visitor& v) {
    v(&FeatureSettings::downscale, "downscale",
      "Factor by which 640 px wide frames are averaged down before features are evaluated; less for narrower frames.", Range{1, 8});
  }
};

/// What leaves remember. Reference: [Cavallari2017] Sec. 2.2.2, steps 1 and 2; [Vitter1985].
struct ReservoirSettings {
  int capacity = 112;           ///< (P) 1024, (T) 112
  int grid_spacing_px = 8;      ///< (P) 4, (T) 8
  bool jitter = true;           ///< (P) false, (T) true
  int examples_per_view = 255;  ///< (P) 0, (T) 255, docs/experiments/places.md

  /// Shows each field to the visitor, with its name, what it means and its range.
  template <class Visitor>
  static void fields(Visitor& v) {
    v(&ReservoirSettings::capacity, "capacity", "Points that a leaf remembers at most.", Range{16, 1024});
    v(&ReservoirSettings::grid_spacing_px, "grid_spacing_px",
      "Spacing of the pixels that a 640 px wide training frame contributes; less for narrower frames.", Range{1, 640});
    v(&ReservoirSettings::examples_per_view, "examples_per_view",
      "Examples learnt of a piece of surface, 10 cm wide, from one direction and distance; 0 for no limit.", Range{0, 255});
    v(&ReservoirSettings::jitter, "jitter", "Take a random pixel of each grid cell instead of its first.");
  }
};

/// How reservoirs become modes. Reference: [Cavallari2017] Sec. 2.2.2, step 3; [Fulkerson2010].
struct ClusteringSettings {
  int min_cluster_size = 8;           ///< (R) 20, (T) 8
  int max_modes = 10;                 ///< (P)
  float covariance_floor_m = 0.005F;  ///< (R) 0.02, (T) 0.005
  bool touched_first = true;          ///< (P) false, (T) true
  int leaves_per_frame = 1024;        ///< (P) 256, (T) 1024
  int point_budget = 16000;           ///< (P) none, (T) 16000

  /// Shows each field to the visitor, with its name, what it means and its range.
  template <class Visitor>
  static void fields(Visitor& v) {
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

/// How camera poses are searched for. Reference: [Cavallari2017] Sec. 2.2.3.
struct PoseEstimatorSettings {
  int pool_size = 4000;       ///< (T); the paper evaluates every pixel
  int num_hypotheses = 256;   ///< (P) 1024, (T) 256
  int num_candidates = 16;    ///< (P) the supplement's last 16
  bool as_published = false;  ///< (P) true

  /// Shows each field to the visitor, with its name, what it means and its range.
  template <class Visitor>
  static void fields(Visitor& v) {
    using S = PoseEstimatorSettings;
    v(&S::pool_size, "pool_size", "Pixels with valid depth that are evaluated; all later samples come from them.", Range{500, 65536});
    v(&S::num_hypotheses, "num_hypotheses", "Hypotheses drawn.", Range{16, 65536});
    v(&S::num_candidates, "num_candidates", "Candidates returned, best first.", Range{1, 64});
    v(&S::as_published, "as_published", "Search as the paper and its authors' code do, without what Foothold adds.");
  }
};

/// The data-free forest: complete trees of random splits. Reference: the authors' random-forest option (R).
struct RandomForestSettings {
  int num_trees = 5;                  ///< (P)
  int depth = 13;                     ///< (T) 8192 leaves a tree, as many as a trained tree has
  int num_features = 256;             ///< (P) half Depth, half DA-RGB
  float min_offset_px_m = 2.0F;       ///< (T)
  float max_offset_px_m = 65.0F;      ///< (T)
  float depth_threshold_mm = 300.0F;  ///< (T)
  float colour_threshold = 25.0F;     ///< (T)
  std::uint64_t seed = 42;            ///< of every random choice

  /// Shows each field to the visitor, with its name, what it means and its range.
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
  FeatureSettings features;            ///< of the image that features are computed on
  ReservoirSettings reservoirs;        ///< of what leaves remember
  ClusteringSettings clustering;       ///< of the modes of leaves
  PoseEstimatorSettings pose;          ///< of hypotheses and their refinement
  float acceptance_threshold = 0.75F;  ///< (T) docs/experiments/trust.md
  int num_rolls = 8;                   ///< (P) 1, (T) 8, docs/experiments/rolled-cameras.md
  float sure_confidence = 0.97F;       ///< (T) docs/experiments/rolled-cameras.md
  float place_radius_m = 4.0F;         ///< (P) 16, as good as one place; (T) 4, docs/experiments/places.md
  float max_relocalise_ms = 0.0F;      ///< answers that repeat do not depend on a clock: a host that must bound time says how
  int memory_budget_mb = 0;            ///< memory grows with what is seen, not with time: a host that must bound it says how
  std::uint64_t seed = 42;             ///< of every random choice

  /// Shows each field to the visitor, with its name, what it means and its range.
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
    v(&S::place_radius_m, "place_radius_m", "Distance from a place's first camera up to which cameras belong to it.", Range{0.5, 16});
    v(&S::max_relocalise_ms, "max_relocalise_ms",
      "Time after which a relocalisation tries no further place or roll [ms]; answers then depend on the machine. 0 for no limit.",
      Range{0, 1e6});
    v(&S::memory_budget_mb, "memory_budget_mb",
      "Memory for what is learnt [10^6 bytes]: when it is used up, detail makes room for new places; 0 for no limit.", Range{0, 1e6});
    v(&S::seed, "seed", "Seed of every random choice.", Range{0, 1.8446744073709552e19});
  }

  /// Named settings: "tuned" (the default) or "paper". @throws InvalidSettings for another name.
  static ForestRelocaliserSettings preset(const std::string& name);

  /// @throws InvalidSettings naming the field, its value and its range.
  void validate() const;
};

}  // namespace foothold

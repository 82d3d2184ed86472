// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// Every setting that the benchmark can change, one section per method.
#pragma once

#include <cstdint>

#include "foothold/fusion/pose_refiner.h"
#include "foothold/relocalisation/keyframe_relocaliser.h"
#include "foothold/relocalisation/settings.h"

namespace foothold::benchmark {

/// Paths start with the method's name: "forest.pose.num_hypotheses", "ferns.num_ferns".
struct BenchmarkSettings {
  ForestRelocaliserSettings forest;
  ForestRelocaliserSettings paper = ForestRelocaliserSettings::preset("paper");
  KeyframeRelocaliserSettings ferns;
  RandomForestSettings random_forest;  ///< used with --forest random
  TsdfSettings map;                    ///< of the methods that refine
  PoseRefinerSettings refiner;         ///< likewise

  template <class Visitor>
  static void fields(Visitor& v) {
    v(&BenchmarkSettings::forest, "forest");
    v(&BenchmarkSettings::paper, "paper");
    v(&BenchmarkSettings::ferns, "ferns");
    v(&BenchmarkSettings::random_forest, "random_forest");
    v(&BenchmarkSettings::map, "map");
    v(&BenchmarkSettings::refiner, "refiner");
  }
};

/// Sets every seed there is.
void set_seeds(BenchmarkSettings& settings, std::uint64_t seed);

}  // namespace foothold::benchmark

// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "foothold/relocalisation/settings.h"

namespace foothold {
namespace {

/// The paper's values, then those of the authors' code where the paper is silent.
ForestRelocaliserSettings paper_preset() {
  ForestRelocaliserSettings settings;
  settings.features.downscale = 1;
  settings.reservoirs.capacity = 1024;
  settings.reservoirs.grid_spacing_px = 4;
  settings.reservoirs.jitter = false;
  settings.reservoirs.examples_per_view = 0;
  settings.clustering.min_cluster_size = 20;
  settings.clustering.covariance_floor_m = 0.02F;
  settings.clustering.touched_first = false;
  settings.clustering.leaves_per_frame = 256;
  settings.clustering.point_budget = 0;
  settings.pose.num_hypotheses = 1024;
  settings.pose.as_published = true;
  settings.num_rolls = 1;
  settings.place_radius_m = 16.0F;
  return settings;
}

}  // namespace

ForestRelocaliserSettings ForestRelocaliserSettings::preset(const std::string& name) {
  if (name == "tuned") return {};
  if (name == "paper") return paper_preset();
  throw InvalidSettings("preset: got '" + name + "', expected tuned or paper");
}

void ForestRelocaliserSettings::validate() const {
  validate_settings(*this);
  if (clustering.min_cluster_size > reservoirs.capacity) {
    throw InvalidSettings("setting clustering.min_cluster_size: got " + std::to_string(clustering.min_cluster_size) +
                          ", expected at most reservoirs.capacity = " + std::to_string(reservoirs.capacity) +
                          ", since no leaf could ever have a mode");
  }
}

}  // namespace foothold

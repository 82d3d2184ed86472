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
  settings.clustering.sigma_m = 0.1F;
  settings.clustering.tau_m = 0.05F;
  settings.clustering.min_cluster_size = 20;
  settings.clustering.covariance_floor_m = 0.02F;
  settings.clustering.max_modes = 10;
  settings.clustering.touched_first = false;
  settings.clustering.leaves_per_frame = 256;
  settings.clustering.point_budget = 0;
  settings.pose.num_hypotheses = 1024;
  settings.pose.max_draws = 6000;
  settings.pose.max_rigidity_error_m = 0.025F;
  settings.pose.scan_modes = false;
  settings.pose.cull_samples = 500;
  settings.pose.first_cull_samples = 500;
  settings.pose.cull_survivors = 64;
  settings.pose.round_samples = 500;
  settings.pose.energy_truncation = 1e6F;
  settings.pose.refinement_iterations = 10;
  settings.pose.final_iterations = 10;
  settings.pose.alignment_iterations = 0;
  settings.pose.ranking_points = 0;
  settings.pose.projection_points = 0;
  settings.num_rolls = 1;
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
  if (pose.first_cull_samples > pose.cull_samples) {
    throw InvalidSettings("setting pose.first_cull_samples: got " + std::to_string(pose.first_cull_samples) +
                          ", expected at most pose.cull_samples = " + std::to_string(pose.cull_samples));
  }
  if (pose.cull_samples > pose.pool_size) {
    throw InvalidSettings("setting pose.cull_samples: got " + std::to_string(pose.cull_samples) +
                          ", expected at most pose.pool_size = " + std::to_string(pose.pool_size));
  }
}

}  // namespace foothold

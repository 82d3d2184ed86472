// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// The command line of replay_sequence.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "common/app_main.h"
#include "foothold/evaluation/kidnap.h"
#include "foothold/fusion/fusion_pipeline.h"
#include "foothold/io/sequence.h"
#include "foothold/relocalisation/keyframe_relocaliser.h"
#include "foothold/relocalisation/settings.h"

namespace foothold::replay {

/// Every setting that the app can change: "fusion.volume.voxel_size_m", "forest.pose.num_hypotheses", "ferns.num_ferns".
struct ReplaySettings {
  FusionSettings fusion;
  ForestRelocaliserSettings forest;
  KeyframeRelocaliserSettings ferns;
  RandomForestSettings random_forest;  ///< used with --forest random

  template <class Visitor>
  static void fields(Visitor& v) {
    v(&ReplaySettings::fusion, "fusion");
    v(&ReplaySettings::forest, "forest");
    v(&ReplaySettings::ferns, "ferns");
    v(&ReplaySettings::random_forest, "random_forest");
  }
};

/// As typed.
struct ReplayOptions {
  std::string sequence;
  std::string method = "forest";
  std::string forest = "default";
  std::string settings_file;
  std::vector<std::string> settings;
  float voxel_size_m = 0.0F;  ///< 0: as the settings say
  apps::DeviceOptions device;
  SequenceOptions recording;
  int stride = 1;

  KidnapOptions kidnaps;
  bool independent = false;

  std::string mesh_file;
  std::string picture_file;
  std::string trajectory_file;
  std::string json_file;
  std::string video_folder;
  int video_every = 1;
  bool show = false;
  bool exclusive_timing = false;
};

void add_replay_options(apps::CommandLine& app, ReplayOptions& options);

/// The settings: seed and --voxel, then the settings file, then --set. @throws InvalidSettings, FileError
ReplaySettings replay_settings(const ReplayOptions& options);

/// Fails early if something asked for cannot be written or shown. @throws FileError, DeviceError, InvalidSettings
void check_outputs(const ReplayOptions& options);

}  // namespace foothold::replay

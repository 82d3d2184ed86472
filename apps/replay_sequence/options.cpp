// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "options.h"

#include <filesystem>

#include "common/display_probe.h"
#include "common/override_settings.h"
#include "common/recording_options.h"
#include "common/view_window.h"
#include "foothold/base/atomic_file.h"
#include "foothold/base/error.h"

namespace foothold::replay {
namespace {

/// A truncation of so many voxels covers a Kinect's noise at arm's length.
constexpr float kTruncation_voxels = 4.0F;

void add_kidnap_options(apps::CommandLine& app, ReplayOptions& options) {
  KidnapOptions& kidnaps = options.kidnaps;
  constexpr int kMostKidnaps = 100000;
  constexpr int kMostFrames = 1000000;
  app.add_option("--kidnap", kidnaps.num_removed, "Leave out so many stretches of frames, at random places")
      .range(0, kMostKidnaps)
      .show_default();
  app.add_option("--kidnap-length", kidnaps.removed_length, "Frames of each").range(1, kMostFrames).show_default();
  app.add_option("--leap", kidnaps.num_leaps, "Jump ahead so many times to what is not mapped yet, and then return; with --independent")
      .range(0, kMostKidnaps)
      .show_default();
  app.add_option("--teleport", kidnaps.num_teleports, "Jump back so many times to an earlier part, and then return")
      .range(0, kMostKidnaps)
      .show_default();
  app.add_option("--blackout", kidnaps.num_blackouts, "Cover the lens so many times while the camera moves on")
      .range(0, kMostKidnaps)
      .show_default();
  app.add_option("--blackout-length", kidnaps.blackout_length, "Frames of each").range(1, kMostFrames).show_default();
  app.add_option("--judged", kidnaps.num_judged, "Frames after each of these by which it is judged").range(1, kMostFrames).show_default();
  app.add_flag("--independent", options.independent, "Each of these alone, out of an undisturbed run whose state is copied");
  app.add_option("--seed", kidnaps.seed, "Seed of every random choice").show_default();
}

void add_output_options(apps::CommandLine& app, ReplayOptions& options) {
  app.add_option("--save-mesh", options.mesh_file, "Write the reconstructed surface as PLY").type_name("FILE");
  app.add_option("--save-picture", options.picture_file, "Write a picture of the reconstructed surface from outside as PNG")
      .type_name("FILE");
  app.add_option("--save-trajectory", options.trajectory_file, "Write the camera's poses in the format of the TUM RGB-D benchmark")
      .type_name("FILE");
  app.add_option("--json", options.json_file, "Write the results (docs/replay.md)").type_name("FILE");
  app.add_option("--video", options.video_folder, "Write the view of each frame as a PNG into a folder").type_name("DIR");
  app.add_option("--video-every", options.video_every, "Only of every Nth frame").range(1, 1000000).show_default();
  app.add_flag("--show", options.show, "Show the view in a window");
}

}  // namespace

void add_replay_options(apps::CommandLine& app, ReplayOptions& options) {
  app.add_option("sequence", options.sequence, apps::kRecordingHelp).required().type_name("SEQUENCE");
  app.add_option("--method", options.method, "What finds a lost camera: forest, ferns or none")
      .one_of({"forest", "ferns", "none"})
      .show_default();
  app.add_option("--forest", options.forest, "A forest file, 'default', or 'random' for one made from the settings random_forest.*")
      .show_default();
  add_kidnap_options(app, options);
  add_output_options(app, options);
  app.add_option("--voxel", options.voxel_size_m, "Size of a voxel [m]; sets the truncation to four of them").range(0.001F, 0.1F);
  app.add_option("--stride", options.stride, "Use every Nth frame").range(1, 1000000).show_default();
  app.add_option("--settings", options.settings_file, "JSON file of settings: {\"fusion\": {\"volume\": {\"max_depth_m\": 4}}}");
  app.add_option("--set", options.settings, "One setting as path=value, such as fusion.volume.max_depth_m=4; repeatable").repeatable();
  apps::add_device_options(app, options.device);
  apps::add_recording_options(app, options.recording);
  app.add_flag("--exclusive-timing", options.exclusive_timing,
               "Decode frames between the timed calls, not beside them in a thread: slower, but gives processor time per frame");
}

ReplaySettings replay_settings(const ReplayOptions& options) {
  ReplaySettings settings;
  settings.forest.seed = options.kidnaps.seed;
  settings.ferns.seed = options.kidnaps.seed;
  settings.random_forest.seed = options.kidnaps.seed;
  if (options.voxel_size_m > 0.0F) {
    settings.fusion.volume.voxel_size_m = options.voxel_size_m;
    settings.fusion.volume.truncation_m = kTruncation_voxels * options.voxel_size_m;
  }
  apps::override_settings(options.settings_file, options.settings, "path=value, such as fusion.volume.voxel_size_m=0.005", settings);
  settings.fusion.validate();
  validate_settings(settings);
  return settings;
}

void check_outputs(const ReplayOptions& options) {
  for (const std::string& path : {options.mesh_file, options.picture_file, options.trajectory_file, options.json_file}) {
    if (!path.empty()) expect_writable(path);
  }
  if (options.show) {
    const std::string missing = apps::describe_missing_display();
    if (!missing.empty()) throw DeviceError("--show: " + missing + "; --video DIR writes the same view as pictures");
  }
  if (options.video_folder.empty()) return;
  const std::filesystem::path parent = std::filesystem::absolute(options.video_folder).lexically_normal().parent_path();
  if (std::filesystem::exists(options.video_folder) ? !std::filesystem::is_directory(options.video_folder)
                                                    : !std::filesystem::is_directory(parent)) {
    throw FileError("--video: '" + options.video_folder +
                    "' cannot be a folder for pictures: expected a new name in an existing folder, or a folder");
  }
}

}  // namespace foothold::replay

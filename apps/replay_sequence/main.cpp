// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// replay_sequence: reconstructs a recording with its own tracker, kidnaps the camera on the way, and tells how that went.
#include <cstdio>

#include "foothold/base/atomic_file.h"
#include "foothold/base/error.h"
#include "foothold/io/image_file.h"
#include "foothold/io/mesh_file.h"
#include "foothold/io/trajectory.h"
#include "options.h"
#include "replay.h"
#include "report.h"

namespace foothold::replay {
namespace {

void save_trajectory(const std::string& path, const ReplayRun& run, const Eigen::Vector3d& origin_m) {
  std::vector<StampedPose> trajectory;
  for (const ReplayFrame& frame : run.frames) {
    if (frame.result.world_from_camera.has_value()) trajectory.push_back({frame.timestamp_s, *frame.result.world_from_camera});
  }
  write_trajectory(path, trajectory, origin_m);
}

void save_picture(const std::string& path, const Image<Rgb8>& picture) {
  if (picture.empty()) throw FileError(path + ": there is no surface to draw");
  write_png(path, picture);
}

int run(const ReplayOptions& options) {
  const ReplaySettings settings = replay_settings(options);
  check_outputs(options);
  const ReplayResult result = replay(options, settings);
  std::printf("%s", text_report(options, result).c_str());
  if (!options.json_file.empty()) write_file_atomically(options.json_file, json_report(options, settings, result));
  if (!options.trajectory_file.empty()) save_trajectory(options.trajectory_file, result.main_run(), result.origin_m);
  if (!options.mesh_file.empty()) write_ply(options.mesh_file, result.main_run().mesh);
  if (!options.picture_file.empty()) save_picture(options.picture_file, result.main_run().picture);
  if (!result.broken_off.empty()) throw FileError(result.broken_off + " (what came before is saved)");
  return apps::interrupted() ? apps::kInterrupted : apps::kSuccess;
}

}  // namespace
}  // namespace foothold::replay

int main(int argc, char** argv) {
  foothold::apps::CommandLine app("Reconstructs a recording with its own tracker, and takes the camera elsewhere on the way if asked to.",
                                  "replay_sequence");
  foothold::replay::ReplayOptions options;
  foothold::replay::add_replay_options(app, options);
  return foothold::apps::run_app(app, argc, argv, [&] { return foothold::replay::run(options); });
}

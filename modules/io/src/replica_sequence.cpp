// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "replica_sequence.h"

#include "numbered_files.h"
#include "numbered_folders.h"

namespace foothold::io {
namespace {

namespace fs = std::filesystem;

constexpr CameraModel kReplica{{600.0F, 600.0F, 599.5F, 339.5F}, {}, {1200, 680}};
constexpr double kDepthUnitsPerM = 6553.5;

}  // namespace

bool looks_like_replica(const fs::path& folder) {
  return !numbered_files(folder / "results", "depth", {".png"}).empty() &&
         !numbered_files(folder / "results", "frame", {".jpg", ".png"}).empty();
}

FoundRecording read_replica(const fs::path& folder, const Context& context) {
  FoundRecording found;
  found.folder = folder;
  found.layout = "Replica";
  NumberedFrames numbered = pair_by_number(numbered_files(folder / "results", "depth", {".png"}),
                                           numbered_files(folder / "results", "frame", {".png", ".jpg"}), folder, context);
  found.tells_poses = fs::exists(folder / "traj.txt");
  if (found.tells_poses) add_pose_list(folder / "traj.txt", numbered);
  found.frames = std::move(numbered.frames);
  found.depth_units_per_m = kDepthUnitsPerM;
  found.calibration.data_set = kReplica;
  found.calibration.data_set_name = "Replica's own";
  return found;
}

}  // namespace foothold::io

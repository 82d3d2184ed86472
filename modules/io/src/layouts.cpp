// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "found_recording.h"
#include "numbered_folders.h"
#include "record3d_sequence.h"
#include "replica_sequence.h"
#include "sens_file.h"
#include "seven_scenes_sequence.h"
#include "stray_scanner_sequence.h"
#include "tum_sequence.h"

namespace foothold::io {

const std::vector<Layout>& layouts() {
  static const std::vector<Layout> all = {
      {"7-Scenes", "frame-000000.depth.png, .color.png, .pose.txt; also 3DMatch, 12-Scenes, BundleFusion", looks_like_seven_scenes,
       read_seven_scenes},
      {"TUM RGB-D", "depth.txt and rgb.txt, or associations.txt; also ICL-NUIM, Bonn, OpenLORIS", looks_like_tum, read_tum},
      {"ScanNet", "a .sens file", has_sens_file, read_sens_folder},
      {"Stray Scanner", "depth/, rgb/, odometry.csv", looks_like_stray_scanner, read_stray_scanner},
      {"Record3D", "EXR_RGBD/depth/0.exr, EXR_RGBD/rgb/0.jpg, metadata.json", looks_like_record3d, read_record3d},
      {"Replica", "results/depth000000.png, results/frame000000.jpg, traj.txt", looks_like_replica, read_replica},
      {"numbered images", "depth/0.png, color/0.jpg, pose/0.txt or a trajectory: ScanNet's export, Redwood, Open3D", has_numbered_folders,
       read_numbered_folders},
  };
  return all;
}

}  // namespace foothold::io

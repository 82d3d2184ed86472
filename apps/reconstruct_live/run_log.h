// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// What happened during a run: poses, losses and recoveries, and the summary of it all.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "foothold/fusion/fusion_pipeline.h"
#include "foothold/io/trajectory.h"
#include "foothold/openni/openni_source.h"
#include "recording_thread.h"

namespace foothold::live {

/// A stretch of frames without a pose.
struct Loss {
  std::int64_t frame = 0;  ///< the first lost one, or the recovered one if it was found again at once
  double timestamp_s = 0.0;
  int num_frames = 0;  ///< that were lost
  bool recovered = false;
};

/// Collects frame by frame.
class RunLog {
 public:
  /// Takes note of what became of a frame. @return What to tell the user, or nothing.
  std::string add(double timestamp_s, const FusionFrameResult& result);
  /// The world has another origin from now on: after a reset, or in a loaded scene. Poses so far mean nothing in it.
  void begin_world();
  /// In a loaded scene the camera is lost before its first frame.
  void begin_lost();

  /// Frames processed so far.
  std::int64_t num_frames() const { return num_frames_; }
  /// Of these, with a pose, in whatever world.
  std::int64_t num_with_pose() const { return num_with_pose_; }
  const std::vector<Loss>& losses() const { return losses_; }
  const std::vector<StampedPose>& trajectory() const { return trajectory_; }

  /// What the run came to besides its frames.
  struct Surroundings {
    std::string ended_by;  ///< frames, duration, quit, interrupt, camera
    OpenNIStatus camera;
    const RecordingThread* recording = nullptr;  ///< if there is one
    std::string record_folder;
    std::string loaded_scene;
    std::vector<std::string> saved;  ///< files
    std::vector<std::string> errors;
    int num_blocks = 0;
  };
  /// The summary as JSON (docs/cameras.md).
  std::string to_json(const Surroundings& surroundings) const;

 private:
  std::int64_t num_frames_ = 0;
  std::int64_t num_with_pose_ = 0;
  std::int64_t num_fused_ = 0;
  std::int64_t num_relocalised_ = 0;
  std::int64_t num_blocks_refused_ = 0;
  std::vector<Loss> losses_;
  bool is_lost_ = false;
  std::vector<StampedPose> trajectory_;
  std::vector<double> frame_ms_;
  RecoveryState state_ = RecoveryState::kTracking;
};

}  // namespace foothold::live

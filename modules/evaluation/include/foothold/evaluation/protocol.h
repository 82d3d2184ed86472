// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// What every protocol shares: where its frames come from, what it notes down, and how it tells of its progress.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "foothold/api/frame_source.h"
#include "foothold/api/relocaliser.h"
#include "foothold/base/trace.h"
#include "foothold/evaluation/pose_error.h"

namespace foothold {

/// A stretch of frames with true poses that can be played from its start.
struct EvaluationInput {
  std::string name;                                    ///< as messages and reports call it
  int num_frames = 0;                                  ///< what will be played, for progress and early errors; 0 if unknown
  std::function<std::unique_ptr<FrameSource>()> open;  ///< begins to play from the first frame
};

/// One attempt to find the camera.
struct TestRecord {
  int input_index = 0;               ///< which of the tested inputs
  std::int64_t frame_index = 0;      ///< the frame's number in its recording
  int num_trained = 0;               ///< frames learnt before the attempt
  SE3 world_from_camera_true;        ///< the recording's own pose of the camera
  std::optional<PoseEstimate> best;  ///< the first estimate, whatever its confidence; empty when the camera was given up as lost
  PoseError error;                   ///< of `best`; infinite without one

  /// Whether the first estimate keeps the limits; false without one.
  bool within(const PoseThreshold& threshold) const { return threshold.contains(error); }
};

/// The durations of one kind of call, an element per call.
struct CallTimes {
  std::vector<double> wall_ms;  ///< by the clock [ms]
  /// Processor time of the calling thread: the whole work on one thread, a part of it on several.
  std::vector<double> cpu_ms;
  /// By stage as the relocaliser names it; a stage that ran several times in a call is summed.
  std::map<std::string, std::vector<double>> stages_ms;
};

/// Everything that a run of a protocol noted down.
struct RunLog {
  std::vector<TestRecord> tests;               ///< in the order of the attempts
  std::vector<SE3> trained_world_from_camera;  ///< poses of the frames that were learnt
  int num_without_pose = 0;                    ///< frames left out, for they have no true pose
  int num_without_depth = 0;                   ///< frames without valid depth, not found and not learnt
  CallTimes train;                             ///< of Relocaliser::train()
  CallTimes relocalise;                        ///< of Relocaliser::relocalise()
  CallTimes update;                            ///< of Relocaliser::update()
  std::size_t state_bytes = 0;                 ///< at the end
  float acceptance_threshold = 0.0F;           ///< the method's own: the confidence from which it is to be believed
};

/// How far a run has come.
struct Progress {
  int num_done = 0;    ///< frames, whether learnt, tested or both
  int num_total = 0;   ///< as the inputs announced; 0 if unknown
  int num_tested = 0;  ///< frames that were tested
  int num_found = 0;   ///< within kFoundThreshold
};

/// What a protocol reports to while it runs.
struct ProtocolOptions {
  /// The trace of the relocaliser's context, if it has one: the source of CallTimes::stages_ms. It is emptied.
  Trace* trace = nullptr;
  /// Called after every frame, from the thread that runs the protocol. What it throws ends the run and passes through.
  std::function<void(const Progress&)> progress;
};

}  // namespace foothold

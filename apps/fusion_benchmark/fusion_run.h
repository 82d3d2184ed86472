// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// Plays a recording through a FusionPipeline that has no relocaliser, and notes down what the tracker did.
#pragma once

#include <functional>
#include <map>
#include <string>
#include <vector>

#include "foothold/api/frame_source.h"
#include "foothold/base/context.h"
#include "foothold/base/trace.h"
#include "foothold/fusion/fusion_pipeline.h"
#include "foothold/io/trajectory.h"

namespace foothold::apps {

/// What happened to a recording.
struct FusionRun {
  std::vector<StampedPose> trajectory;  ///< of the frames that were tracked
  std::vector<SE3> estimated;           ///< the same poses, where the truth is known
  std::vector<SE3> truth;
  int num_frames = 0;
  int num_good = 0;
  int num_poor = 0;
  int num_lost = 0;
  int num_fused = 0;
  std::vector<double> confidences;  ///< of the tracked frames
  std::vector<double> cpu_ms;       ///< per frame, of all threads
  std::vector<double> wall_ms;
  std::map<std::string, std::vector<double>> stages_ms;  ///< wall, per frame
  double map_mb = 0.0;                                   ///< 1e6 bytes
  double peak_mb = 0.0;                                  ///< of the process, images included
};

/// Plays every `stride`-th frame, starting at the first frame's true pose where there is one. Frames are decoded between the timed calls.
/// @param trace     The trace of `context`. It is emptied.
/// @param progress  Called after each frame with the number done; the run ends early when it returns false.
FusionRun run_fusion(const Context& context, Trace& trace, const Sequence& sequence, int stride, const FusionSettings& settings,
                     const std::function<bool(int)>& progress);

/// How far alignment with a map moves the true poses of frames: what no relocaliser that aligns its answers can beat on a recording whose
/// true poses do not agree with one another.
struct Ceiling {
  int num_within_5 = 0;   ///< 5 cm and 5 deg
  int num_within_10 = 0;  ///< 10 cm and 10 deg
  int num_accepted = 0;   ///< by the acceptance classifier
  std::vector<double> distances_m;
};

struct CeilingRun {
  int num_frames = 0;
  Ceiling aligned;  ///< by the last stage of refinement alone
  Ceiling refined;  ///< as what a relocaliser proposes is: by all stages, which align further
};

/// Fuses one recording with its true poses, then aligns the frames of another in the same world, from their true poses.
CeilingRun run_ceiling(const Context& context, const Sequence& map, const Sequence& tested, int stride, const FusionSettings& settings,
                       const std::function<bool(int)>& progress);

}  // namespace foothold::apps

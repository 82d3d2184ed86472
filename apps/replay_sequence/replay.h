// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// Plays a recording to a reconstruction, undisturbed and with the camera kidnapped.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "foothold/api/frame_source.h"
#include "foothold/base/mesh.h"
#include "foothold/evaluation/kidnap.h"
#include "foothold/evaluation/mesh_distance.h"
#include "foothold/evaluation/trajectory_error.h"
#include "foothold/fusion/fusion_pipeline.h"
#include "options.h"

namespace foothold::replay {

/// A frame that was played, and what became of it.
struct ReplayFrame {
  PlayStep step;           ///< step.frame counts the frames used
  std::int64_t index = 0;  ///< the frame's number in its recording
  double timestamp_s = 0.0;
  std::optional<SE3> world_from_camera_true;
  bool has_depth = true;
  FusionFrameResult result;
  double cpu_ms = 0.0;  ///< processor time of all threads; NaN without --exclusive-timing
};

struct ReplayRun {
  std::vector<ReplayFrame> frames;
  double wall_s = 0.0;  ///< of the whole run, reading of frames included
  Mesh mesh;
  Image<Rgb8> picture;  ///< of the surface from outside; only if asked for
  std::size_t map_bytes = 0;
  std::size_t relocaliser_bytes = 0;
};

/// A kidnap and how it ended.
struct KidnapRecord {
  Kidnap kidnap;
  std::vector<ReplayFrame> frames;  ///< those by which it was judged
  std::optional<double> mapped;     ///< part of the first frame's view that was mapped; empty without true poses
  KidnapOutcome outcome;
};

/// How far one surface lies from another, and the other from the one.
struct SurfaceComparison {
  std::string run;
  std::string reference;      ///< the run whose surface it is held against, or "true poses": all frames fused from these
  MeshDistance accuracy;      ///< of the run's vertices from the reference
  MeshDistance completeness;  ///< of the reference's vertices from the run
};

/// How far a run's poses are from the true ones.
struct RunError {
  int num_frames = 0;  ///< with a pose and a true pose
  AbsoluteTrajectoryError raw;
  AbsoluteTrajectoryError aligned;
};

struct ReplayResult {
  ReplayRun undisturbed;
  std::optional<ReplayRun> kidnapped;  ///< with all kidnaps one after another
  std::vector<KidnapRecord> kidnaps;
  KidnapOutcome whole_kidnapped;            ///< wrong poses anywhere in the kidnapped run
  std::vector<SurfaceComparison> surfaces;  ///< of the kidnapped and the undisturbed run; empty without kidnaps in one run
  double peak_mb = 0.0;
  bool complete = true;      ///< false: interrupted, or the recording broke off
  std::string broken_off;    ///< why the recording could not be read to its end; empty if it could
  Eigen::Vector3d origin_m;  ///< Sequence::origin_m() of the recording

  /// The run whose surface and trajectory are saved.
  const ReplayRun& main_run() const { return kidnapped.has_value() ? *kidnapped : undisturbed; }
};

/// Runs what the options ask for. Stops early, with what there is, when the user wants it.
/// @throws FileError, InvalidSettings, DeviceError
ReplayResult replay(const ReplayOptions& options, const ReplaySettings& settings);

/// The error of a run; empty without frames that have both poses.
std::optional<RunError> run_error(const ReplayRun& run);

}  // namespace foothold::replay

// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// What a replay came to, for people and for programs.
#pragma once

#include <map>
#include <string>

#include "foothold/evaluation/statistics.h"
#include "replay.h"

namespace foothold::replay {

inline constexpr double kMb = 1e-6;  ///< megabytes in a byte

/// What became of the frames of a run.
struct RunCounts {
  int num_frames = 0;
  int num_tracking = 0;
  int num_settling = 0;
  int num_lost = 0;
  int num_fused = 0;
  int num_relocalised = 0;
  int num_without_true_pose = 0;
  int num_without_depth = 0;
  int num_blocks_refused = 0;          ///< by a full map, summed over frames
  double out_of_range_fraction = 0.0;  ///< of the depth of frames that have some, on average
};
RunCounts count_frames(const ReplayRun& run);

/// Milliseconds per frame by stage, over the frames that had it; "cpu" with --exclusive-timing.
std::map<std::string, Spread> stage_times(const ReplayRun& run);

/// Outcomes by kind of kidnap, and "all" if there are several.
std::map<std::string, KidnapSummary> kidnap_summaries(const ReplayResult& result);

/// Markdown tables.
std::string text_report(const ReplayOptions& options, const ReplayResult& result);
/// A JSON document, described in docs/replay.md.
std::string json_report(const ReplayOptions& options, const ReplaySettings& settings, const ReplayResult& result);

}  // namespace foothold::replay

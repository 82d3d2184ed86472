// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// Whether a recording can be what it is taken for: unit of depth, intrinsics, convention of poses.
#pragma once

#include <string>
#include <vector>

#include "foothold/io/recording.h"

namespace foothold {

/// The depths of rooms [m]: a recording whose median lies outside is read in the wrong unit, or is no room.
inline constexpr double kLeastMedianDepth_m = 0.5;
/// The largest median depth of a room [m].
inline constexpr double kMostMedianDepth_m = 5.0;

/// What a few frames, spread over a recording, look like.
struct RecordingCheck {
  int num_depth_frames = 0;      ///< looked at for depth
  int num_unreadable = 0;        ///< of those that were to be looked at, those whose depth cannot be read
  std::string first_error;       ///< why the first of them cannot
  double valid_fraction = 0.0;   ///< of their pixels, those with depth
  double median_depth_m = 0.0;   ///< 0 without any
  double within_fraction = 0.0;  ///< of their depths, those between kLeastMedianDepth_m and kMostMedianDepth_m

  /// Pairs of frames, some motion apart, whose depth was projected into one another with the recording's poses.
  int num_pose_pairs = 0;
  /// Of the points that should be seen in the other frame, those that are, at their depth to 2 cm and 2 %; 1 for perfect poses of a still
  /// scene.
  double pose_agreement = 0.0;
  /// True if they agree well, and far less if depth were twice or half as large: depth and positions have one unit.
  bool poses_fit = false;
  /// The convention under which more agree by far, as SequenceOptions::pose_convention has it; empty if there is none.
  std::string better_convention;
  /// The unit of depth under which more agree by far; 0 if there is none.
  double better_depth_units_per_m = 0.0;
  /// What else makes more agree by far, in words: another focal length, another scale of depth, poses of another time.
  std::string better_otherwise;
  double better_agreement = 0.0;  ///< the share that agrees under what is better, in [0, 1]

  /// What a user should be told, a sentence or two each.
  std::vector<std::string> warnings;
};

/// Looks at a few frames. Frames that cannot be read are passed over: whoever loads them hears of it.
/// Cost: decodes the depth of about 16 frames.
RecordingCheck check_recording(const Recording& recording);

}  // namespace foothold

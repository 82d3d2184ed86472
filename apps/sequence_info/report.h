// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// What Foothold understands of a recording, for people and for programs.
#pragma once

#include <string>

#include "foothold/io/recording_check.h"

namespace foothold::info {

/// How a recording runs through time and space.
struct Course {
  int num_with_pose = 0;
  double duration_s = 0.0;
  double interval_s = 0.0;  ///< median between frames
  int num_gaps = 0;         ///< intervals of more than three times the median
  double longest_gap_s = 0.0;
  int longest_gap_frame = 0;      ///< the frame before it
  Eigen::Vector3d extent_m;       ///< of the box around all positions
  double path_m = 0.0;            ///< between consecutive frames with poses
  double longest_step_m = 0.0;    ///< between two consecutive frames
  double longest_step_deg = 0.0;  ///< the same for rotation
  int longest_step_frame = 0;     ///< the frame behind it
};
Course course_of(const RecordingFacts& facts);

std::string text_report(const Recording& recording, const Course& course, const RecordingCheck& check);
/// A JSON document, described in docs/sequences.md.
std::string json_report(const Recording& recording, const Course& course, const RecordingCheck& check);

}  // namespace foothold::info

// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// Parsing trajectories and looking poses up in them.
#pragma once

#include <filesystem>
#include <optional>
#include <string_view>
#include <vector>

#include "foothold/io/trajectory.h"
#include "recorded_pose.h"

namespace foothold::io {

/// read_trajectory() of a text already in memory.
std::vector<StampedPose> parse_trajectory(std::string_view text, const std::filesystem::path& file);

/// A pose of the ground truth and its time; empty where tracking was lost.
struct TruePose {
  double timestamp_s = 0.0;
  std::optional<RecordedPose> pose;
};

/// Parses a trajectory as read_trajectory() does, but in double precision and with samples that are lost: those with a number that is not
/// finite, or a quaternion of zeros. @throws FileError
std::vector<TruePose> parse_ground_truth(std::string_view text, const std::filesystem::path& file);

/// The pose at a time: that of an equal stamp, or the one between its neighbours, linear in position and along the great arc in rotation.
/// @return Empty outside the trajectory, beside a lost sample, and where the neighbours are more than `max_gap_s` apart.
/// Reference: [Shoemake1985] for the rotation.
std::optional<RecordedPose> interpolate(const std::vector<TruePose>& trajectory, double timestamp_s, double max_gap_s);

}  // namespace foothold::io

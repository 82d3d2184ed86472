// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// Parsing trajectories and looking poses up in them.
#pragma once

#include <filesystem>
#include <optional>
#include <string_view>
#include <vector>

#include "foothold/io/trajectory.h"

namespace foothold::io {

/// read_trajectory() of a text already in memory.
std::vector<StampedPose> parse_trajectory(std::string_view text, const std::filesystem::path& file);

/// The pose at a time: that of an equal stamp, or the one between its neighbours, linear in position and along the great arc in rotation.
/// @return Empty outside the trajectory, and where the neighbours are more than `max_gap_s` apart.
/// Reference: [Shoemake1985] for the rotation.
std::optional<SE3> interpolate(const std::vector<StampedPose>& trajectory, double timestamp_s, double max_gap_s);

}  // namespace foothold::io

// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// Files that hold the poses of all frames, one after another, without times.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string_view>

#include "recorded_pose.h"

namespace foothold::io {

/// Parses a list of poses by the number of their frame, from 0: lines of 12 or 16 numbers, as KITTI and Replica have them, or Redwood's
/// log, in which a line of three whole numbers, the first of them the frame's, precedes four lines of four. @throws FileError naming the
/// line.
std::map<long, std::optional<RecordedPose>> parse_pose_list(std::string_view text, const std::filesystem::path& file);

}  // namespace foothold::io

// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// Exports of Stray Scanner, an app for phones and tablets with LiDAR.
#pragma once

#include "found_recording.h"

namespace foothold::io {

/// True for a folder with depth/ and odometry.csv.
bool looks_like_stray_scanner(const std::filesystem::path& folder);

/// A row of odometry.csv.
struct OdometryRow {
  double timestamp_s = 0.0;
  long frame = 0;
  std::optional<RecordedPose> pose;
};

/// Parses rows of timestamp, frame, x, y, z, qx, qy, qz, qw; more columns are passed over. @throws FileError naming the line.
std::vector<OdometryRow> parse_odometry(std::string_view text, const std::filesystem::path& file);

/// Reads it. Colour must have been unpacked from rgb.mp4 into rgb/. @throws FileError
FoundRecording read_stray_scanner(const std::filesystem::path& folder, const Context& context);

}  // namespace foothold::io

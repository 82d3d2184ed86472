// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// metadata.json of Record3D, an app for phones with LiDAR.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "camera_model.h"
#include "recorded_pose.h"

namespace foothold::io {

/// The rows of numbers under a name of a JSON text: two of [[1, 2], [3, 4]], one of [1, 2] and of 1. Empty where the name is missing.
/// null, NaN and Infinity, as Python writes them, are NaN.
/// @throws FileError if anything else stands among the numbers, or the text ends there.
std::vector<std::vector<double>> json_rows(std::string_view text, std::string_view name, const std::filesystem::path& file);

/// What is told of the frames, by their number.
struct Record3dMetadata {
  std::vector<std::optional<RecordedPose>> poses;  ///< in axes of OpenGL, relative to the first frame
  std::vector<double> times_s;                     ///< empty where they are not told
  double frame_rate_hz = 0.0;                      ///< 0 where it is not told
  std::optional<CameraModel> camera;               ///< of the colour images
  bool is_median = false;  ///< the camera is the median of those told for each frame, as autofocus and stabilisation move the lens
  float variation = 0.0F;  ///< by how much these differ from it at most, as a part of the longer side of the images
};

/// Parses "poses", rows of qx qy qz qw x y z, "perFrameIntrinsicCoeffs", rows of fx fy cx cy, or else "K", a 3x3 matrix column by column,
/// "w" and "h", the size of the images that these belong to, "frameTimestamps" and "fps". All of them may be missing.
/// @throws FileError naming the first of them that is not as expected.
Record3dMetadata parse_record3d_metadata(std::string_view text, const std::filesystem::path& file);

}  // namespace foothold::io

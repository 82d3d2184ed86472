// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// The calibration of a recording: from what the user says, its files, its header, or its data set, in this order.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "camera_model.h"
#include "foothold/api/frame.h"
#include "foothold/io/sequence.h"

namespace foothold::io {

/// Parses a 4x4 matrix, row by row, as a rigid transform and makes its rotation exactly orthonormal.
/// @throws FileError unless it is 16 finite numbers, a rotation to within kRotationTolerance, a translation of at most 1e6 m, and a last
/// row of 0 0 0 1.
SE3 parse_transform(std::string_view text, const std::filesystem::path& file);

/// What a layout knows of its cameras, whatever files there are.
struct CalibrationHints {
  /// The cameras that a recording's own header tells.
  std::optional<CameraModel> depth;
  std::optional<CameraModel> colour;
  std::optional<SE3> depth_from_colour;
  std::string header;  ///< what messages call it
  /// The data set's own camera: assumed where no file tells, and only if images have its size.
  std::optional<CameraModel> data_set;
  std::string data_set_name;
  /// What the data set adds to intrinsics from a file: depth of 585/585/320/240 is 7-Scenes', whose colour is not registered.
  bool may_be_seven_scenes = false;
};

/// A calibration, and where it comes from.
struct RecordingCalibration {
  CameraModel depth;
  CameraModel colour;
  SE3 depth_from_colour;
  std::string source;                       ///< for people: file names, "the data set's own", ...
  std::optional<double> depth_units_per_m;  ///< where the calibration file tells
  std::string warning;                      ///< empty if there is nothing to say

  RgbdCalibration pinholes() const { return {depth.intrinsics, colour.intrinsics, depth_from_colour}; }
};

/// Finds the calibration of the recording in a folder.
/// @throws FileError naming file, value and image size if it cannot be that of these images, or if there is none.
RecordingCalibration find_calibration(const std::filesystem::path& folder, const CalibrationHints& hints, const ImageSize& depth_size,
                                      const ImageSize& colour_size, const SequenceOptions& options);

}  // namespace foothold::io

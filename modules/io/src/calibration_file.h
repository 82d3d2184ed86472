// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// Intrinsics, transforms and poses as matrices in text files.
#pragma once

#include <filesystem>
#include <string_view>

#include "foothold/api/frame.h"

namespace foothold::io {

/// By how much an entry of R^T R may differ from the identity before a matrix no longer counts as a rotation. The rotations of 7-Scenes
/// are orthonormal to 1e-4.
inline constexpr double kRotationTolerance = 1e-2;

/// Parses a 4x4 matrix, row by row, as a rigid transform and makes its rotation exactly orthonormal.
/// @throws FileError unless it is 16 finite numbers, a rotation to within kRotationTolerance, and a last row of 0 0 0 1.
SE3 parse_transform(std::string_view text, const std::filesystem::path& file);

/// Parses a 3x3 camera matrix. @throws FileError unless it is 9 finite numbers, focal lengths are positive, and the rest reads 0 0 0 0 1.
Intrinsics parse_intrinsics(std::string_view text, const std::filesystem::path& file);

/// The calibration of a folder in the 7-Scenes layout.
///
/// Depth: camera-intrinsics.txt (3x3), or the data set's 585/585/320/240. Colour: colour-intrinsics.txt (3x3, or the depth camera's) and
/// depth-from-colour.txt (4x4, or the identity). With neither of the two, depth of the data set's own intrinsics means the data set's own,
/// unregistered colour camera, and any other intrinsics mean colour registered to depth.
RgbdCalibration read_seven_scenes_calibration(const std::filesystem::path& folder);

}  // namespace foothold::io

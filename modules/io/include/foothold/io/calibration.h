// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// Calibrations of RGB-D cameras, as files.
#pragma once

#include <string>

#include "foothold/api/frame.h"

namespace foothold {

/// Reads the calibration of a camera from the files that recordings have: camera-intrinsics.txt, and optionally colour-intrinsics.txt and
/// depth-from-colour.txt, as docs/sequences.md describes them. A recording's own folder will do.
/// @throws FileError if camera-intrinsics.txt is missing, or a file is damaged.
RgbdCalibration read_calibration(const std::string& folder);

}  // namespace foothold

// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// In which unit and convention a recording is read: as the user says, else as files beside it say, else as its layout is.
#pragma once

#include <string>

#include "calibration_file.h"
#include "found_recording.h"

namespace foothold::io {

/// What depth images count, and where that comes from.
struct DepthUnit {
  double units_per_m;
  std::string source;
};

/// From the options, depth-scale.txt, the intrinsics or the layout. @throws InvalidSettings, FileError for values that are no unit
DepthUnit settle_depth_unit(const FoundRecording& found, const RecordingCalibration& calibration, const SequenceOptions& options);

/// From the options, pose-convention.txt or the layout. @throws InvalidSettings, FileError for words that are no convention
PoseConvention settle_pose_convention(const FoundRecording& found, const SequenceOptions& options);

}  // namespace foothold::io

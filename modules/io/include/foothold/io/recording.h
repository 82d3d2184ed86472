// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// Recordings on disk: what is known of them before their images are decoded.
#pragma once

#include <Eigen/Core>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "foothold/api/frame_source.h"
#include "foothold/base/context.h"
#include "foothold/io/sequence.h"

namespace foothold {

/// How Foothold understands a recording.
struct RecordingFacts {
  std::string folder;                                 ///< the recording's folder
  std::string layout;                                 ///< such as "7-Scenes"
  int depth_width = 0;                                ///< columns [px]
  int depth_height = 0;                               ///< rows [px]
  int colour_width = 0;                               ///< columns [px]; 0 without colour
  int colour_height = 0;                              ///< rows [px]; 0 without colour
  RgbdCalibration calibration;                        ///< as recorded, before colour is registered
  std::string calibration_source;                     ///< where the calibration comes from, in words
  std::string depth_distortion;                       ///< in words; "none" without any
  std::string colour_distortion;                      ///< likewise
  double depth_units_per_m = 0.0;                     ///< steps of the depth images in a metre
  std::string depth_unit_source;                      ///< where the unit comes from, in words
  bool depth_is_continuous = false;                   ///< it has fractions of units, too
  std::string pose_convention;                        ///< as SequenceOptions::pose_convention; "as-is" for Foothold's own
  std::vector<double> times_s;                        ///< of each frame
  std::vector<std::optional<SE3>> world_from_camera;  ///< of each frame, relative to Sequence::origin_m()
};

/// The unit of depth: "1/5000 m", "metres".
std::string depth_unit_text(const RecordingFacts& facts);

/// A recording on disk.
class Recording : public Sequence {
 public:
  /// What was understood of the recording.
  virtual const RecordingFacts& facts() const = 0;
  /// Depth [m] of one frame without its colour. Thread-safe. @pre 0 <= index < num_frames() @throws FileError
  virtual Image<float> load_depth(int index) const = 0;
};

/// Opens the recording in a folder: open_sequence() for those who want to know more of it. @throws FileError, InvalidSettings
std::shared_ptr<Recording> open_recording(const std::string& folder, const Context& context, const SequenceOptions& options = {});

}  // namespace foothold

// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// Records frames in the layout of 7-Scenes, so that open_sequence() plays them back.
#pragma once

#include <string>
#include <vector>

#include "foothold/api/frame.h"

namespace foothold {

/// Changes depth [m] to what comes back from a recording of it: whole millimetres, 0 beyond 65.534 m. What is reconstructed from such
/// frames is reconstructed alike from their recording.
void round_depth_as_recorded(Image<float>& depth_m);

/// Writes frame-000000.{color.png,depth.png,pose.txt}, ... and the calibration of the first frame. Each file appears complete or not at
/// all.
///
/// Depth is kept in whole millimetres up to 65.534 m; beyond, and where there is no measurement, it is 0.
class SevenScenesWriter {
 public:
  /// Creates the folder. @throws FileError if that fails, or the folder holds frames already.
  explicit SevenScenesWriter(const std::string& folder);

  /// Adds a frame, numbered on from the last. Poses: either every frame has one, or none.
  /// @pre describe_frame_error(frame.view()) is empty but for a colour of another size than depth; sizes and calibration are those of the
  /// first frame; pose or no pose likewise.
  /// @throws FileError, after which the recording holds the frames before this one.
  void write(const RgbdFrame& frame);

  /// Frames written so far.
  int num_frames() const { return static_cast<int>(times_s_.size()); }

  /// Writes timestamps.txt. A recording without it, as after a crash, plays at 30 frames a second. @throws FileError
  void finish();

 private:
  void write_calibration() const;
  void write_files(const std::string& stem, const RgbdFrame& frame) const;
  std::string path(const std::string& name) const;

  std::string folder_;
  std::vector<double> times_s_;
  // What the first frame settled for all.
  RgbdCalibration calibration_;
  int width_ = 0;
  int height_ = 0;
  int colour_width_ = 0;
  int colour_height_ = 0;
  bool has_poses_ = false;
};

}  // namespace foothold

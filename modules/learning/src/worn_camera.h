// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// What rendered recordings lack: cameras that are badly calibrated, adjust themselves and move while they expose, and poses that drift.
#pragma once

#include <Eigen/Core>

#include "foothold/api/frame.h"
#include "foothold/base/random.h"
#include "foothold/base/se3.h"

namespace foothold {

/// A camera with faults of its own, the same in all its frames, and faults that vary from frame to frame.
///
/// Its own: colour is shifted against depth; depth is distorted smoothly over the image, more so far away. Varying: exposure and white
/// balance, as of a camera that adjusts itself; blur by motion; near surfaces that bleed over their edges.
class WornCamera {
 public:
  /// @param wear  0 for none, 1 for that of an old Kinect.
  WornCamera(float wear, Random& random);

  /// Spoils a frame as this camera would.
  void wear(RgbdFrame& frame, Random& random) const;

 private:
  void distort_depth(Image<float>& depth) const;
  void bleed_edges(Image<float>& depth, Random& random) const;
  void adjust_colour(Image<Rgb8>& colour, Random& random) const;

  float wear_;
  int shift_u_px_;
  int shift_v_px_;
  Eigen::Vector3f distortion_;  ///< relative to depth at 1 m: everywhere, from left to right, from the middle to the border
};

/// Puts up to three things into the view that are not in the map, each in front of what is there. @param size  Of the largest, as a part of
/// the image's width.
void add_strangers(RgbdFrame& frame, float size, Random& random);

/// An error of poses that varies slowly along a recording, as that of a tracker does.
class PoseDrift {
 public:
  /// @param drift_m, drift_deg  Amplitude along and about each axis.
  PoseDrift(float drift_m, float drift_deg, Random& random);

  /// The pose as the tracker would have it. @param frame_index  Position in the recording, 30 to the second.
  SE3 apply(const SE3& world_from_camera, int frame_index) const;

 private:
  float drift_m_;
  float drift_rad_;
  Tangent6 phase_;
  Tangent6 period_frames_;
};

}  // namespace foothold

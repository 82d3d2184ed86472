// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// One RGB-D frame: as a view into memory that a tracker owns, and as owned images.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "foothold/base/camera.h"
#include "foothold/base/image.h"
#include "foothold/base/se3.h"

namespace foothold {

/// The calibration of an RGB-D camera. Poses belong to the depth camera.
struct RgbdCalibration {
  Intrinsics depth;   ///< of the depth camera [px]
  Intrinsics colour;  ///< of the colour camera [px]
  /// Transforms points of the colour camera into the depth camera; the identity for registered images.
  SE3 depth_from_colour;
};

/// True if two calibrations are equal in every number.
bool same_calibration(const RgbdCalibration& a, const RgbdCalibration& b);

/// A non-owning RGB-D frame. Depth is z in metres, dense rows; zero, negative and NaN all mean "no measurement" (InfiniTAM writes -1).
/// Depth and colour live in the same kind of memory and have the same size.
///
/// The images belong to the caller. They must stay alive and unchanged during the call that the frame is passed to; nobody looks at them
/// afterwards, but for CUDA memory as Relocaliser::train() says.
///
/// Focal lengths are positive: u points right and v down. For a camera model with fy < 0, whose v points up, flip the rows of both images,
/// or negate fy, set cy to height - 1 - cy and flip the rows. depth_from_colour is a rotation and a translation in metres; matrices that
/// mirror (OpenGL's axes) or scale (millimetres) are refused.
struct Frame {
  ImageView<const float> depth;  ///< z [m]; NaN, 0 and less mean no measurement
  ColourView colour;             ///< may be empty
  RgbdCalibration calibration;   ///< of both cameras
  std::int64_t index = 0;        ///< position in the recording, or a count of frames
  double timestamp_s = 0.0;      ///< when the image was taken [s]
};

/// Checks what every consumer of frames relies on: images present, equal sizes, one kind of memory, valid intrinsics, rigid
/// depth_from_colour. Whoever takes frames throws ContractViolation with this text for one that breaks it (see contract.h).
/// @return Empty if the frame is well formed, else what is wrong with it.
std::string describe_frame_error(const Frame& frame);

/// An RGB-D frame that owns its images, as read from a camera or a recording.
struct RgbdFrame {
  Image<float> depth;                    ///< z [m]
  Image<Rgb8> colour;                    ///< may be empty
  RgbdCalibration calibration;           ///< of both cameras
  std::int64_t index = 0;                ///< position in the recording
  double timestamp_s = 0.0;              ///< when the images were taken [s]
  std::optional<SE3> world_from_camera;  ///< the true pose of the depth camera, where known

  /// A frame that looks at these images, which must outlive it.
  Frame view() const { return {depth.view(), colour_view(colour), calibration, index, timestamp_s}; }
};

}  // namespace foothold

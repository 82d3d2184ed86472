// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// A rendered room, written in the ways in which people have recordings.
#pragma once

#include <string>
#include <vector>

#include "foothold/api/frame.h"
#include "foothold/base/context.h"
#include "foothold/io/recording_check.h"
#include "recorded_pose.h"

namespace foothold::test {

/// A context that keeps what it is told.
struct LoggingContext {
  std::string messages;
  std::string warnings;
  Context context{[this] {
    ContextOptions options;
    options.num_threads = 1;
    options.log = [this](LogLevel level, const std::string& message) {
      messages += message + "\n";
      if (level == LogLevel::kWarning) warnings += message + "\n";
    };
    return options;
  }()};
};

/// Frames of the kitchen, 160x120 pixels, with noise. Rendered once.
const std::vector<RgbdFrame>& room_frames();

/// Depth in whole units. @param units_per_m  such as 1000 for millimetres.
Image<std::uint16_t> depth_in_units(const Image<float>& depth_m, double units_per_m);

/// A 4x4 matrix as text, of 12 digits.
std::string matrix_text(const io::RecordedPose& pose);
/// The pose of a frame, in double precision.
io::RecordedPose pose_of(const RgbdFrame& frame);

/// How a recording is written.
struct RoomFormat {
  double units_per_m = 1000.0;
  /// Makes what is written of a frame's pose.
  io::RecordedPose (*pose)(const io::RecordedPose& world_from_camera) = [](const io::RecordedPose& unchanged) { return unchanged; };
  std::string intrinsics_file = "camera-intrinsics.txt";  ///< empty for none
};

/// Writes room_frames() in the layout of 7-Scenes.
void write_room_as_seven_scenes(const std::string& folder, const RoomFormat& format = {});

/// Writes room_frames() in the layout of the TUM benchmark. @param s_per_unit  of its times. @param w_first  order of quaternions.
void write_room_as_tum(const std::string& folder, const RoomFormat& format, double s_per_unit = 1.0, bool w_first = false);

/// "fx 0 cx ..." of the room's camera.
std::string room_intrinsics_text();

}  // namespace foothold::test

// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// Recordings of analytic rooms, rendered on the fly: no download, exact poses.
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "foothold/api/frame_source.h"
#include "foothold/base/context.h"
#include "foothold/base/settings.h"
#include "foothold/synthetic/room_changes.h"
#include "foothold/synthetic/view_effects.h"

namespace foothold {

/// Which room, changed how, seen how. Changes and effects leave the camera's path as it is, but for mirroring.
struct SyntheticSequenceSettings : RoomChanges, ViewEffects {
  /// One of synthetic_room_names(), or "training-K" for K = 0, 1, 2, ...
  std::string room = "office";
  /// "train" or "test": two paths through the same room.
  std::string trajectory = "train";
  /// Length at 30 frames a second. Longer sequences begin with the shorter ones.
  int frames = 300;
  /// Size of the images [px]; the focal length of 585 px at 640 scales with the width.
  int width = 640;
  int height = 480;  ///< rows [px]
  /// 0 exact, 1 as a Kinect sees it, 2 a bad day of it.
  int noise = 1;
  /// Varies the noise and the hand's tremor; neither the room nor the path.
  std::uint64_t seed = 42;
  /// Turns the camera about its optical axis, clockwise as seen from behind it [deg].
  float roll_deg = 0.0F;

  /// Shows each field to the visitor, with its name, what it means and its range.
  template <class Visitor>
  static void fields(Visitor& v) {
    v(&SyntheticSequenceSettings::room, "room", "Room to render; training-K for any K is a training room.");
    v(&SyntheticSequenceSettings::trajectory, "trajectory", "Path through the room: train or test.");
    v(&SyntheticSequenceSettings::frames, "frames", "Length at 30 frames a second.", Range{1, 1000000});
    v(&SyntheticSequenceSettings::width, "width", "Width of the images [px].", Range{16, 4096});
    v(&SyntheticSequenceSettings::height, "height", "Height of the images [px].", Range{16, 4096});
    v(&SyntheticSequenceSettings::noise, "noise", "0 exact, 1 as a Kinect sees it, 2 a bad day of it.", Range{0, 2});
    v(&SyntheticSequenceSettings::seed, "seed", "Varies noise and tremor, not the room.", Range{0, 18446744073709551615.0});
    v(&SyntheticSequenceSettings::roll_deg, "roll_deg", "Turns the camera about its optical axis [deg].", Range{-180, 180});
    RoomChanges::fields(v);
    ViewEffects::fields(v);
  }

  /// @throws InvalidSettings naming the field, its value and what is allowed.
  void validate() const;
};

/// True if a sequence name means a room to render: it begins with "synthetic:".
bool is_synthetic_spec(const std::string& spec);

/// Reads "synthetic:NAME?key=value&key=value"; the prefix may be missing, noise may be true or false.
/// @throws InvalidSettings for an unknown room (listing the known ones), an unknown key (with the nearest known one) or a bad value.
SyntheticSequenceSettings parse_synthetic_spec(const std::string& spec);

/// The shortest spec with these settings.
std::string synthetic_spec(const SyntheticSequenceSettings& settings);

/// A recording whose frames are rendered when they are loaded. Its name is the spec; colour and depth are registered; every pose is exact.
///
/// @param context  Frames are rendered on the CPU by as many threads as it has. load() may be called from several threads at once.
/// @throws InvalidSettings as validate() does.
///
/// Determinism: a frame is a function of the settings and its index, whatever the threads.
/// Cost:        40 to 60 ms of CPU time for a frame of 640x480 pixels with noise.
std::unique_ptr<Sequence> make_synthetic_sequence(const SyntheticSequenceSettings& settings, const Context& context);

}  // namespace foothold

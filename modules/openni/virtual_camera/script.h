// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// What the virtual camera does and when, read from environment variables; see docs/cameras.md, "The virtual camera".
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace foothold::virtual_camera {

/// What a camera does after the last frame of its sequence.
enum class EndOfSequence {
  kHold,      ///< repeats the last frame, as a camera at rest
  kRestart,   ///< jumps to the first frame
  kPingPong,  ///< plays backwards and forwards
  kUnplug,    ///< vanishes for good
};

/// Something that happens at a frame of the camera's clock.
struct Event {
  enum class Kind {
    kUnplug,    ///< the device vanishes from the bus; time and playhead go on
    kStall,     ///< the device stays but sends nothing; the playhead goes on
    kJump,      ///< the playhead moves to frame `target` of the sequence
    kNoDepth,   ///< only colour frames are sent
    kNoColour,  ///< only depth frames are sent
    kCover,     ///< the lens is covered: depth without measurements, black colour
    kFreeze,    ///< the playhead stands still
  };
  Kind kind = Kind::kStall;
  std::int64_t first_tick = 0;
  std::int64_t num_ticks = 0;  ///< how long it lasts; kForever without an end; 1 for a jump
  std::int64_t target = 0;     ///< frame to jump to

  static constexpr std::int64_t kForever = INT64_MAX;
};

/// Calls into one camera that pretend to be a driver that hangs [s]; 0 means no delay.
struct Delays {
  double open_s = 0.0;
  double start_s = 0.0;
  double stop_s = 0.0;
  double close_s = 0.0;
};

/// One run of the virtual camera.
struct Script {
  std::vector<std::string> sequences;  ///< one camera each; empty: no device is ever found
  double frames_per_second = 30.0;
  EndOfSequence at_end = EndOfSequence::kHold;
  std::vector<Event> events;   ///< of the first camera; the others play undisturbed
  std::vector<Delays> delays;  ///< by camera; those beyond have none
  std::string lock_file;       ///< a device cannot be opened while another process holds this file's lock; empty: no lock
  bool has_colour = true;
  bool has_depth = true;     ///< false: a webcam
  bool registers = true;     ///< offers depth-to-colour registration, if the sequence's images are registered
  bool synchronises = true;  ///< offers depth-colour synchronisation
  bool fine_depth = false;   ///< sends depth in 0.1 mm only, instead of 1 mm or 0.1 mm

  /// True if an event of this kind is under way at a tick.
  bool is_active(Event::Kind kind, std::int64_t tick) const;
  /// The frame that a jump at this tick leads to; negative if there is none.
  std::int64_t jump_target(std::int64_t tick) const;
};

/// Reads "unplug@100+30, jump@200=50, stall@300": kind, frame, and optionally a length in frames and a target.
/// @throws InvalidSettings naming what cannot be understood.
std::vector<Event> parse_events(const std::string& text);

/// Reads the script from environment variables; `lookup` returns a variable's value or nullptr.
/// @throws InvalidSettings naming the variable and what was expected.
Script read_script(const std::function<const char*(const char*)>& lookup);

/// The frame of a sequence that a playhead position shows; -1 once the camera has unplugged itself at the end.
int frame_at(std::int64_t playhead, int num_frames, EndOfSequence at_end);

}  // namespace foothold::virtual_camera

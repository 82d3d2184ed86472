// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// Virtual cameras on the real OpenNI2 library, for tests.
#pragma once

#include <initializer_list>
#include <string>
#include <vector>

#include "foothold/openni/openni_source.h"

namespace foothold::test {

/// The camera sends whole millimetres, and its pattern consists of them.
constexpr float kHalfMillimetre_m = 0.0005F;

/// Plugs virtual cameras in for as long as it lives. Make it before any source: the driver reads its script when OpenNI2 is initialised.
class VirtualRig {
 public:
  struct Variable {
    std::string name;  ///< without its prefix: "" is FOOTHOLD_VIRTUAL_CAMERA, "EVENTS" is FOOTHOLD_VIRTUAL_CAMERA_EVENTS
    std::string value;
  };
  /// The camera is a pattern of 160x120 at 30 Hz unless the script says otherwise.
  VirtualRig(std::initializer_list<Variable> script = {});
  ~VirtualRig();
  VirtualRig(const VirtualRig&) = delete;
  VirtualRig& operator=(const VirtualRig&) = delete;

 private:
  void set(const Variable& variable);

  std::vector<std::string> names_;
};

/// Settings for the rig's camera, with time limits for tests.
OpenNISettings rig_settings();

/// The next frame; fails the test if none comes for a long time, however busy the machine is.
RgbdFrame next_frame(OpenNISource& source);

/// Reads, dropping frames, until the camera is in a state; fails the test if that takes long.
OpenNIStatus wait_for_state(OpenNISource& source, OpenNIState state);

/// The number of the pattern's frame that an image shows, modulo 256.
int pattern_frame(const RgbdFrame& frame);

/// The largest difference between a frame's depth and the pattern's [m]. `step` is 2 for half-size images.
float max_depth_error_m(const RgbdFrame& frame, int step = 1);

/// True if every colour pixel is the pattern's.
bool has_pattern_colour(const RgbdFrame& frame, int step = 1);

/// The message of the error that a function throws; fails the test if it throws none, or another type.
template <class Error, class Function>
std::string message_of(Function function) {
  try {
    function();
  } catch (const Error& error) {
    return error.what();
  }
  return "no such error was thrown";
}

}  // namespace foothold::test

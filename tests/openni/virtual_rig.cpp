// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "virtual_rig.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdlib>

#include "pattern_sequence.h"
#include "support/catch.h"

namespace foothold::test {
namespace {

using virtual_camera::PatternSequence;
using Clock = std::chrono::steady_clock;
constexpr auto kPatience = std::chrono::seconds(30);  ///< for a machine that is busy with other things

}  // namespace

VirtualRig::VirtualRig(std::initializer_list<Variable> script) {
  const char* path = std::getenv("LD_LIBRARY_PATH");
  if (path == nullptr || std::string(path).find(FOOTHOLD_VIRTUAL_CAMERA_DIR) == std::string::npos) {
    FAIL("run this test through ctest, or with LD_LIBRARY_PATH=" FOOTHOLD_VIRTUAL_CAMERA_DIR);
  }
  set({"", "pattern:160x120"});
  for (const Variable& variable : script) set(variable);
}

VirtualRig::~VirtualRig() {
  for (const std::string& name : names_) unsetenv(name.c_str());
}

void VirtualRig::set(const Variable& variable) {
  names_.push_back("FOOTHOLD_VIRTUAL_CAMERA" + (variable.name.empty() ? "" : "_" + variable.name));
  setenv(names_.back().c_str(), variable.value.c_str(), 1);
}

OpenNISettings rig_settings() {
  OpenNISettings settings;
  settings.width = 160;
  settings.height = 120;
  settings.read_timeout_ms = 200;
  settings.silence_timeout_ms = 400;
  return settings;
}

RgbdFrame next_frame(OpenNISource& source) {
  RgbdFrame frame;
  const Clock::time_point start = Clock::now();
  while (Clock::now() - start < kPatience) {
    if (source.read(frame) == ReadStatus::kFrame) return frame;
  }
  FAIL("no frame came; " << source.status().message);
  return frame;
}

OpenNIStatus wait_for_state(OpenNISource& source, OpenNIState state) {
  RgbdFrame frame;
  const Clock::time_point start = Clock::now();
  while (Clock::now() - start < kPatience) {
    const OpenNIStatus status = source.status();
    if (status.state == state) return status;
    source.read(frame);
  }
  FAIL("the state did not come; " << source.status().message);
  return {};
}

int pattern_frame(const RgbdFrame& frame) { return frame.colour(0, 0).b; }

float max_depth_error_m(const RgbdFrame& frame, int step) {
  float error_m = 0.0F;
  for (int v = 0; v < frame.depth.height(); ++v) {
    for (int u = 0; u < frame.depth.width(); ++u) {
      const float expected_m = 0.001F * static_cast<float>(PatternSequence::depth_mm(u * step, v * step, pattern_frame(frame)));
      error_m = std::max(error_m, std::abs(frame.depth(u, v) - expected_m));
    }
  }
  return error_m;
}

bool has_pattern_colour(const RgbdFrame& frame, int step) {
  for (int v = 0; v < frame.colour.height(); ++v) {
    for (int u = 0; u < frame.colour.width(); ++u) {
      const Rgb8 expected = PatternSequence::colour(u * step, v * step, pattern_frame(frame));
      const Rgb8 actual = frame.colour(u, v);
      if (actual.r != expected.r || actual.g != expected.g || actual.b != expected.b) return false;
    }
  }
  return true;
}

}  // namespace foothold::test

// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// Cameras that go away and come back.
#include <string>
#include <vector>

#include "foothold/base/trace.h"
#include "foothold/openni/openni_source.h"
#include "support/catch.h"
#include "virtual_rig.h"

namespace foothold::test {
namespace {

using Catch::Matchers::Contains;

constexpr double kGenerous_ms = 5000.0;  ///< for a read whose time limit is a fifth of a second, on a busy machine

TEST_CASE("OpenNISource: survives being unplugged and plugged in again") {
  const VirtualRig rig{{"EVENTS", "unplug@5+20"}};
  std::vector<std::string> messages;
  OpenNISource source(rig_settings(), {}, [&](LogLevel, const std::string& message) { messages.push_back(message); });
  RgbdFrame before = next_frame(source);
  RgbdFrame frame = before;
  while (pattern_frame(frame) < 25) {
    before = frame;
    frame = next_frame(source);
  }
  CHECK(pattern_frame(before) < 5);
  CHECK(max_depth_error_m(frame) < kHalfMillimetre_m);
  CHECK(has_pattern_colour(frame));
  CHECK(frame.timestamp_s > before.timestamp_s);  // though the camera's own clock may have started anew
  CHECK(frame.index > before.index);
  const OpenNIStatus status = source.status();
  CHECK(status.num_reopened == 1);
  CHECK(status.message.empty());
  REQUIRE_FALSE(messages.empty());
  CHECK_THAT(messages.front(), Contains("was unplugged"));
}

TEST_CASE("OpenNISource: reads time out while the camera is away, and the source can be destroyed") {
  const VirtualRig rig{{"EVENTS", "unplug@2"}};
  OpenNISource source(rig_settings());
  const OpenNIStatus status = wait_for_state(source, OpenNIState::kWaitingForDevice);
  CHECK_THAT(status.message, Contains("waiting until it is plugged in again"));
  RgbdFrame frame;
  source.read(frame);  // a last pair may have been left
  const Stopwatch watch;
  CHECK(source.read(frame) == ReadStatus::kTimedOut);
  CHECK(watch.elapsed_ms() < kGenerous_ms);
}

TEST_CASE("OpenNISource: reads time out while the camera stalls, and go on afterwards") {
  const VirtualRig rig{{"EVENTS", "stall@5+40"}};
  OpenNISource source(rig_settings());
  const OpenNIStatus status = wait_for_state(source, OpenNIState::kSilent);
  CHECK_THAT(status.message, Contains("sent nothing") && Contains("port of the computer"));
  CHECK(wait_for_state(source, OpenNIState::kStreaming).message.empty());
  CHECK(max_depth_error_m(next_frame(source)) < kHalfMillimetre_m);
  CHECK(source.status().num_reopened >= 1);
}

TEST_CASE("OpenNISource: tells colour without depth from silence") {
  const std::string features = GENERATE(as<std::string>{}, "", "no-sync");
  const VirtualRig rig{{"EVENTS", "nodepth@3"}, {"FEATURES", features}};
  OpenNISource source(rig_settings());
  std::string message;
  for (int i = 0; i < 100 && message.find("colour but no depth") == std::string::npos; ++i) {
    RgbdFrame frame;
    source.read(frame);
    message = source.status().message;
  }
  CHECK_THAT(message, Contains("colour but no depth") && Contains("projector"));
}

TEST_CASE("OpenNISource: follows the scene through jumps and a covered lens") {
  const VirtualRig rig{{"EVENTS", "cover@3+3,jump@8=100"}};
  OpenNISource source(rig_settings());
  bool covered = false;
  bool jumped = false;
  for (int i = 0; i < 60 && !(covered && jumped); ++i) {
    const RgbdFrame frame = next_frame(source);
    covered |= frame.depth(10, 10) == 0.0F && frame.colour(10, 10).r == 0;
    jumped |= pattern_frame(frame) >= 100;
  }
  CHECK(covered);
  CHECK(jumped);
}

}  // namespace
}  // namespace foothold::test

// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include <map>
#include <string>

#include "foothold/base/error.h"
#include "script.h"
#include "support/catch.h"
#include "virtual_rig.h"

namespace foothold::test {
namespace {

using namespace virtual_camera;  // NOLINT(google-build-using-namespace)
using Catch::Matchers::Contains;

Script script_of(const std::map<std::string, std::string>& variables) {
  return read_script([&](const char* name) {
    const auto found = variables.find(name);
    return found != variables.end() ? found->second.c_str() : nullptr;
  });
}

TEST_CASE("parse_events: reads kinds, frames, lengths and targets") {
  const auto events = parse_events("unplug@100+30, jump@200=50,stall@300");
  REQUIRE(events.size() == 3);
  CHECK(events[0].kind == Event::Kind::kUnplug);
  CHECK(events[0].first_tick == 100);
  CHECK(events[0].num_ticks == 30);
  CHECK(events[1].kind == Event::Kind::kJump);
  CHECK(events[1].first_tick == 200);
  CHECK(events[1].target == 50);
  CHECK(events[2].kind == Event::Kind::kStall);
  CHECK(events[2].num_ticks == Event::kForever);
  CHECK(parse_events("").empty());
}

TEST_CASE("parse_events: explains what it cannot read") {
  const std::string text = GENERATE(as<std::string>{}, "explode@3", "stall", "stall@", "stall@x", "stall@3+", "jump@3",
                                    "jump@3=", "jump@3+4", "stall@3 4", "stall@-1", "stall@3=4", "stall@99999999999999999999");
  CHECK_THAT(message_of<InvalidSettings>([&] { parse_events(text); }), Contains("'" + text + "'") && Contains("unplug@100+30"));
}

TEST_CASE("Script: events last as long as they say") {
  Script script;
  script.events = parse_events("cover@10+5,stall@20,jump@30=7");
  CHECK_FALSE(script.is_active(Event::Kind::kCover, 9));
  CHECK(script.is_active(Event::Kind::kCover, 10));
  CHECK(script.is_active(Event::Kind::kCover, 14));
  CHECK_FALSE(script.is_active(Event::Kind::kCover, 15));
  CHECK_FALSE(script.is_active(Event::Kind::kUnplug, 12));
  CHECK(script.is_active(Event::Kind::kStall, 1000000));
  CHECK(script.jump_target(30) == 7);
  CHECK(script.jump_target(31) == -1);
}

TEST_CASE("read_script: without variables a camera plays at 30 Hz") {
  const Script script = script_of({});
  CHECK(script.sequences.size() == 1);
  CHECK(script.frames_per_second == 30.0);
  CHECK(script.at_end == EndOfSequence::kHold);
  CHECK(script.events.empty());
  CHECK(script.delays.empty());
  CHECK(script.lock_file.empty());
  CHECK(script.has_depth);
  CHECK(script.has_colour);
  CHECK(script.registers);
  CHECK(script.synchronises);
  CHECK_FALSE(script.fine_depth);
}

TEST_CASE("read_script: reads every variable") {
  const Script script = script_of({{"FOOTHOLD_VIRTUAL_CAMERA", "a | b"},
                                   {"FOOTHOLD_VIRTUAL_CAMERA_FPS", "12.5"},
                                   {"FOOTHOLD_VIRTUAL_CAMERA_AT_END", "pingpong"},
                                   {"FOOTHOLD_VIRTUAL_CAMERA_DELAYS", "open=1.5, 2.close=3"},
                                   {"FOOTHOLD_VIRTUAL_CAMERA_FEATURES", "no-depth,no-colour,no-registration,no-sync,fine-depth"}});
  CHECK(script.sequences == std::vector<std::string>{"a", "b"});
  CHECK(script.frames_per_second == 12.5);
  CHECK(script.at_end == EndOfSequence::kPingPong);
  REQUIRE(script.delays.size() == 3);
  CHECK(script.delays[0].open_s == 1.5);
  CHECK(script.delays[2].close_s == 3.0);
  CHECK_FALSE(script.has_depth);
  CHECK_FALSE(script.has_colour);
  CHECK_FALSE(script.registers);
  CHECK_FALSE(script.synchronises);
  CHECK(script.fine_depth);
  CHECK(script_of({{"FOOTHOLD_VIRTUAL_CAMERA", "none"}}).sequences.empty());
}

TEST_CASE("read_script: names the variable that is wrong") {
  CHECK_THAT(message_of<InvalidSettings>([] {
               script_of({{"FOOTHOLD_VIRTUAL_CAMERA_FPS", "fast"}});
             }),
             Contains("_FPS") && Contains("'fast'"));
  CHECK_THAT(message_of<InvalidSettings>([] { script_of({{"FOOTHOLD_VIRTUAL_CAMERA_AT_END", "stop"}}); }), Contains("_AT_END"));
  CHECK_THAT(message_of<InvalidSettings>([] { script_of({{"FOOTHOLD_VIRTUAL_CAMERA_DELAYS", "open"}}); }), Contains("_DELAYS"));
  CHECK_THAT(message_of<InvalidSettings>([] { script_of({{"FOOTHOLD_VIRTUAL_CAMERA_DELAYS", "1234.open=3"}}); }), Contains("_DELAYS"));
  CHECK_THAT(message_of<InvalidSettings>([] { script_of({{"FOOTHOLD_VIRTUAL_CAMERA_FEATURES", "no-color"}}); }), Contains("_FEATURES"));
}

TEST_CASE("frame_at: what the camera shows at and after the end") {
  CHECK(frame_at(0, 4, EndOfSequence::kHold) == 0);
  CHECK(frame_at(3, 4, EndOfSequence::kHold) == 3);
  CHECK(frame_at(100, 4, EndOfSequence::kHold) == 3);
  CHECK(frame_at(4, 4, EndOfSequence::kRestart) == 0);
  CHECK(frame_at(4, 4, EndOfSequence::kUnplug) == -1);
  const int there_and_back[] = {0, 1, 2, 3, 2, 1, 0, 1};
  for (int i = 0; i < 8; ++i) CHECK(frame_at(i, 4, EndOfSequence::kPingPong) == there_and_back[i]);
  CHECK(frame_at(5, 1, EndOfSequence::kPingPong) == 0);
}

}  // namespace
}  // namespace foothold::test

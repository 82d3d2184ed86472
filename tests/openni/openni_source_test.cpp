// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "foothold/openni/openni_source.h"

#include <chrono>
#include <string>
#include <thread>
#include <vector>

#include "foothold/frames/register_colour.h"
#include "pattern_sequence.h"
#include "support/catch.h"
#include "virtual_rig.h"

namespace foothold::test {
namespace {

constexpr float kFocalError_px = 0.01F;  ///< the field of view passes through a float in radians

TEST_CASE("list_openni_devices: names the cameras and their modes in order") {
  const VirtualRig rig{{"", "pattern:160x120|pattern:320x240"}};
  const std::vector<OpenNIDeviceInfo> devices = list_openni_devices();
  REQUIRE(devices.size() == 2);
  CHECK(devices[0].uri == "foothold://0");
  CHECK(devices[0].name == "Virtual camera (pattern:160x120)");
  CHECK(devices[1].uri == "foothold://1");
  REQUIRE(devices[1].depth_modes.size() == 4);
  CHECK(devices[1].depth_modes[0].width == 320);
  CHECK(devices[1].depth_modes[0].height == 240);
  CHECK(devices[1].depth_modes[0].fps == 30);
  CHECK(devices[1].depth_modes[0].format == "depth 1 mm");
  REQUIRE(devices[1].colour_modes.size() == 2);
  CHECK(devices[1].colour_modes[1].width == 160);
  CHECK(devices[1].colour_modes[1].format == "RGB 8 bit");
}

TEST_CASE("list_openni_devices: is empty without a camera") {
  const VirtualRig rig{{"", "none"}};
  CHECK(list_openni_devices().empty());
}

TEST_CASE("OpenNISource: delivers matching depth and colour, unmirrored, in metres") {
  const VirtualRig rig;
  OpenNISource source(rig_settings());
  double last_time_s = -1.0;
  std::int64_t last_index = -1;
  for (int i = 0; i < 10; ++i) {
    const RgbdFrame frame = next_frame(source);
    REQUIRE(describe_frame_error(frame.view()).empty());
    CHECK(frame.depth.width() == 160);
    CHECK(frame.depth.height() == 120);
    CHECK(max_depth_error_m(frame) < kHalfMillimetre_m);
    CHECK(frame.depth(0, 0) == 0.0F);
    CHECK(has_pattern_colour(frame));
    CHECK(frame.timestamp_s > last_time_s);
    CHECK(frame.index > last_index);
    CHECK_FALSE(frame.world_from_camera.has_value());
    last_time_s = frame.timestamp_s;
    last_index = frame.index;
  }
  const OpenNIStatus status = source.status();
  CHECK(status.state == OpenNIState::kStreaming);
  CHECK(status.message.empty());
  CHECK(status.device.uri == "foothold://0");
  CHECK(status.num_pairs >= 10);
}

TEST_CASE("OpenNISource: depth has the bits that a recording of it reads back") {
  const VirtualRig rig;
  OpenNISource source(rig_settings());
  const RgbdFrame frame = next_frame(source);
  int num_different = 0;
  for (int v = 0; v < frame.depth.height(); ++v) {
    for (int u = 0; u < frame.depth.width(); ++u) {
      const auto depth_mm = static_cast<float>(virtual_camera::PatternSequence::depth_mm(u, v, pattern_frame(frame)));
      num_different += frame.depth(u, v) != depth_mm / 1000.0F ? 1 : 0;
    }
  }
  CHECK(num_different == 0);
}

TEST_CASE("OpenNISource: takes intrinsics from the field of view, with the principal point in the middle") {
  const VirtualRig rig;
  OpenNISource source(rig_settings());
  const RgbdFrame frame = next_frame(source);
  const Intrinsics expected = virtual_camera::PatternSequence::intrinsics(160, 120);
  for (const Intrinsics& actual : {frame.calibration.depth, frame.calibration.colour}) {
    CHECK(actual.fx == Approx(expected.fx).margin(kFocalError_px));
    CHECK(actual.fy == Approx(expected.fy).margin(kFocalError_px));
    CHECK(actual.cx == Approx(expected.cx).margin(kFocalError_px));
    CHECK(actual.cy == Approx(expected.cy).margin(kFocalError_px));
  }
}

TEST_CASE("OpenNISource: reads half-size images") {
  const VirtualRig rig;
  OpenNISettings settings = rig_settings();
  settings.width = 80;
  settings.height = 60;
  OpenNISource source(settings);
  const RgbdFrame frame = next_frame(source);
  CHECK(frame.depth.width() == 80);
  CHECK(max_depth_error_m(frame, 2) < kHalfMillimetre_m);
  CHECK(has_pattern_colour(frame, 2));
  CHECK(frame.calibration.depth.fx == Approx(80.0F).margin(kFocalError_px));
}

TEST_CASE("OpenNISource: reads depth in tenths of a millimetre") {
  const VirtualRig rig{{"FEATURES", "fine-depth"}};
  OpenNISource source(rig_settings());
  CHECK(source.status().device.depth_modes.front().format == "depth 0.1 mm");
  CHECK(max_depth_error_m(next_frame(source)) < 0.1F * kHalfMillimetre_m);
}

TEST_CASE("OpenNISource: pairs by time stamps where the camera cannot synchronise") {
  const VirtualRig rig{{"FEATURES", "no-sync"}};
  OpenNISource source(rig_settings());
  for (int i = 0; i < 5; ++i) {
    const RgbdFrame frame = next_frame(source);
    CHECK(max_depth_error_m(frame) < kHalfMillimetre_m);
    CHECK(has_pattern_colour(frame));
  }
}

TEST_CASE("OpenNISource: colour may have another size than depth, each with its own calibration") {
  const VirtualRig rig{{"", "pattern:640x480"}};
  OpenNISettings settings = rig_settings();
  settings.registration = GENERATE(as<std::string>{}, "auto", "off");
  settings.width = 320;
  settings.height = 240;
  settings.colour_width = 640;
  settings.colour_height = 480;
  OpenNISource source(settings);
  RgbdFrame frame = next_frame(source);
  REQUIRE(frame.depth.width() == 320);
  REQUIRE(frame.colour.width() == 640);
  CHECK(max_depth_error_m(frame, 2) < kHalfMillimetre_m);
  CHECK(has_pattern_colour(frame));
  const Intrinsics depth = virtual_camera::PatternSequence::intrinsics(320, 240);
  const Intrinsics colour = virtual_camera::PatternSequence::intrinsics(640, 480);
  CHECK(frame.calibration.depth.fx == Approx(depth.fx).margin(kFocalError_px));
  CHECK(frame.calibration.depth.cx == Approx(depth.cx));
  CHECK(frame.calibration.colour.fy == Approx(colour.fy).margin(kFocalError_px));
  CHECK(frame.calibration.colour.cy == Approx(colour.cy));

  register_colour(frame);
  CHECK(describe_frame_error(frame.view()).empty());
  CHECK(is_registered(frame.view()));
  CHECK(frame.colour(100, 100).g == Approx(virtual_camera::PatternSequence::colour(200, 200, 0).g).margin(1));
}

TEST_CASE("OpenNISource: depth is registered by software to colour of another size") {
  const VirtualRig rig{{"FEATURES", "no-registration"}};
  OpenNISettings settings = rig_settings();
  settings.width = 80;
  settings.height = 60;
  settings.colour_width = 160;
  settings.colour_height = 120;
  RgbdCalibration calibration;
  calibration.depth = virtual_camera::PatternSequence::intrinsics(80, 60);
  calibration.colour = virtual_camera::PatternSequence::intrinsics(160, 120);
  OpenNISource source(settings, calibration);
  const RgbdFrame frame = next_frame(source);
  CHECK(source.status().registered);
  CHECK(frame.calibration.depth.fx == Approx(80.0F));
  CHECK(frame.calibration.colour.fx == 160.0F);
  CHECK(frame.depth(40, 30) ==
        Approx(0.001F * static_cast<float>(virtual_camera::PatternSequence::depth_mm(80, 60, pattern_frame(frame)))));
}

TEST_CASE("OpenNISource: chooses a camera by index and by URI") {
  const VirtualRig rig{{"", "pattern:160x120|pattern:320x240"}};
  OpenNISettings settings = rig_settings();
  settings.device = GENERATE(as<std::string>{}, "1", "foothold://1");
  settings.width = 320;
  settings.height = 240;
  OpenNISource source(settings);
  CHECK(next_frame(source).depth.width() == 320);
  CHECK(source.status().device.uri == "foothold://1");
}

TEST_CASE("OpenNISource: two cameras stream side by side, and one goes on when the other is closed") {
  const VirtualRig rig{{"", "pattern:160x120|pattern:160x120"}};
  OpenNISettings settings = rig_settings();
  settings.device = "1";
  OpenNISource second(settings);
  {
    OpenNISource first(rig_settings());
    next_frame(first);
    next_frame(second);
  }
  for (int i = 0; i < 5; ++i) CHECK(max_depth_error_m(next_frame(second)) < kHalfMillimetre_m);
}

TEST_CASE("OpenNISource: a slow reader gets the newest pair and learns how many it missed") {
  const VirtualRig rig{{"FPS", "100"}};
  OpenNISettings settings = rig_settings();
  settings.fps = 100;
  OpenNISource source(settings);
  const RgbdFrame before = next_frame(source);
  std::this_thread::sleep_for(std::chrono::milliseconds(300));
  const RgbdFrame after = next_frame(source);
  const OpenNIStatus status = source.status();
  CHECK(after.index > before.index + 1);
  CHECK(status.num_skipped >= after.index - before.index - 1);
}

TEST_CASE("OpenNISource: a calibration of the caller's replaces the camera's intrinsics") {
  const VirtualRig rig;
  RgbdCalibration calibration;
  calibration.depth = {150.0F, 151.0F, 80.0F, 61.0F};
  calibration.colour = {140.0F, 141.0F, 79.0F, 60.0F};
  calibration.depth_from_colour.translation = {-0.025F, 0.0F, 0.0F};
  OpenNISettings settings = rig_settings();

  SECTION("registered by the camera: depth is seen by the colour camera") {
    OpenNISource source(settings, calibration);
    const RgbdFrame frame = next_frame(source);
    CHECK(source.status().registered);
    CHECK(frame.calibration.depth.fx == 140.0F);
    CHECK(frame.calibration.colour.fx == 140.0F);
    CHECK(frame.calibration.depth_from_colour.translation.isZero());
    CHECK(max_depth_error_m(frame) < kHalfMillimetre_m);
  }
  SECTION("registered by Foothold") {
    settings.registration = "software";
    OpenNISource source(settings, calibration);
    const RgbdFrame frame = next_frame(source);
    CHECK(source.status().registered);
    CHECK(frame.calibration.depth.fx == 140.0F);
    CHECK(frame.calibration.depth_from_colour.translation.isZero());
    CHECK(max_depth_error_m(frame) > 0.01F);  // the pixels have moved
    CHECK(has_pattern_colour(frame));
  }
  SECTION("not registered") {
    settings.registration = "off";
    OpenNISource source(settings, calibration);
    const RgbdFrame frame = next_frame(source);
    CHECK_FALSE(source.status().registered);
    CHECK(frame.calibration.depth.fx == 150.0F);
    CHECK(frame.calibration.colour.fx == 140.0F);
    CHECK(frame.calibration.depth_from_colour.translation.x() == -0.025F);
    CHECK(max_depth_error_m(frame) < kHalfMillimetre_m);
  }
}

TEST_CASE("OpenNISource: warns if nothing can register depth and colour") {
  const VirtualRig rig{{"FEATURES", "no-registration"}};
  std::vector<std::string> messages;
  OpenNISource source(rig_settings(), {}, [&](LogLevel, const std::string& message) { messages.push_back(message); });
  REQUIRE(messages.size() == 1);
  CHECK(messages.front().find("no registration") != std::string::npos);
  CHECK_FALSE(source.status().registered);
  CHECK(max_depth_error_m(next_frame(source)) < kHalfMillimetre_m);
}

TEST_CASE("OpenNISource: a camera without a colour sensor delivers grey frames, after a warning") {
  const VirtualRig rig{{"FEATURES", "no-colour"}};
  std::vector<std::string> messages;
  OpenNISource source(rig_settings(), {}, [&](LogLevel, const std::string& message) { messages.push_back(message); });
  REQUIRE(messages.size() == 1);
  CHECK(messages.front().find("no colour sensor") != std::string::npos);
  for (int i = 0; i < 5; ++i) {
    const RgbdFrame frame = next_frame(source);
    CHECK(describe_frame_error(frame.view()).empty());
    CHECK(frame.depth(10, 10) > 0.0F);
    CHECK(frame.colour(10, 10).r == 128);
    CHECK(frame.calibration.colour.fx == frame.calibration.depth.fx);
  }
}

TEST_CASE("OpenNISource: locks exposure and white balance without complaint") {
  const VirtualRig rig;
  OpenNISettings settings = rig_settings();
  settings.lock_exposure = true;
  settings.lock_white_balance = true;
  settings.settle_ms = 0;
  int num_messages = 0;
  OpenNISource source(settings, {}, [&](LogLevel, const std::string&) { ++num_messages; });
  for (int i = 0; i < 10; ++i) next_frame(source);
  CHECK(num_messages == 0);
}

TEST_CASE("OpenNISettings: every default") {
  const OpenNISettings settings;
  CHECK_NOTHROW(settings.validate());
  std::vector<std::string> texts;
  for (const SettingDescription& setting : describe_settings(settings)) texts.push_back(setting.path + "=" + setting.value);
  CHECK(texts == std::vector<std::string>{"device=", "width=640", "height=480", "colour_width=0", "colour_height=0", "fps=30",
                                          "registration=auto", "synchronise=true", "lock_exposure=false", "lock_white_balance=false",
                                          "settle_ms=1000", "pair_tolerance_ms=0", "open_timeout_ms=15000", "read_timeout_ms=1000",
                                          "silence_timeout_ms=3000", "close_timeout_ms=5000"});
}

}  // namespace
}  // namespace foothold::test

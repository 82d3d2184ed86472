// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// Drivers that never return. They leave threads behind and OpenNI2 initialised, so this file runs last.
#include <string>

#include "foothold/base/trace.h"
#include "foothold/openni/openni_source.h"
#include "support/catch.h"
#include "virtual_rig.h"

namespace foothold::test {
namespace {

using Catch::Matchers::Contains;

constexpr double kWellBelowTheHang_ms = 30000.0;  ///< the driver hangs for ten minutes; the time limits add up to a few seconds

TEST_CASE("OpenNISource: a driver that hangs costs a time-out, and other cameras go on") {
  const Stopwatch watch;
  const VirtualRig rig{{"", "pattern:160x120|pattern:160x120|pattern:160x120|pattern:160x120|pattern:160x120"},
                       {"EVENTS", "stall@3"},
                       {"DELAYS", "0.stop=600,1.open=600,2.start=600,3.close=600"}};
  OpenNISettings settings = rig_settings();
  settings.close_timeout_ms = 300;
  settings.device = "4";
  OpenNISource healthy(settings);
  next_frame(healthy);

  settings.open_timeout_ms = 500;
  settings.device = "1";
  CHECK_THAT(message_of<DeviceError>([&] { OpenNISource{settings}; }), Contains("has not answered") && Contains("opening 'foothold://1'"));
  settings.device = "2";
  CHECK_THAT(message_of<DeviceError>([&] { OpenNISource{settings}; }), Contains("has not answered") && Contains("starting the streams"));
  CHECK_THAT(message_of<DeviceError>([] { list_openni_devices(300); }), Contains("has not answered") && Contains("listing the cameras"));

  settings.open_timeout_ms = 15000;
  settings.device = "3";
  std::string message;
  {
    OpenNISource source(settings, {}, [&](LogLevel, const std::string& text) { message = text; });
    next_frame(source);
  }
  CHECK_THAT(message, Contains("has not answered") && Contains("closing the camera"));

  settings.device = "0";
  {
    OpenNISource source(settings);  // falls silent, is to be opened anew, and hangs when it is closed
    const OpenNIStatus status = wait_for_state(source, OpenNIState::kNotAnswering);
    CHECK_THAT(status.message, Contains("has not answered") && Contains("closing the camera"));
    RgbdFrame frame;
    source.read(frame);
    CHECK(source.read(frame) == ReadStatus::kTimedOut);
  }
  next_frame(healthy);
  CHECK(watch.elapsed_ms() < kWellBelowTheHang_ms);
}

}  // namespace
}  // namespace foothold::test

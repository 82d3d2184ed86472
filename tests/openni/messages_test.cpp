// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "messages.h"

#include "support/catch.h"

namespace foothold::test {
namespace {

using namespace capture;  // NOLINT(google-build-using-namespace)
using Catch::Matchers::Contains;

TEST_CASE("no_device_advice: follows what is on the USB") {
  CHECK_THAT(no_device_advice({}), Contains("lsusb") && Contains("virtual") && Contains("docs/cameras.md"));
  const UsbCamera kinect{"Kinect for Xbox 360", UsbCamera::Support::kKinect1, 0x045e, 0x02ae, 1, 2};
  CHECK_THAT(no_device_advice({kinect}), Contains("045e:02ae") && Contains("libfreenect"));
  const UsbCamera realsense{"RealSense D435", UsbCamera::Support::kNone, 0x8086, 0x0b07, 1, 2};
  CHECK_THAT(no_device_advice({realsense}), Contains("RealSense D435") && Contains("no driver"));
  const UsbCamera xtion{"PrimeSense, Xtion or Structure camera", UsbCamera::Support::kPrimeSense, 0x1d27, 0x0601, 998, 999};
  CHECK_THAT(no_device_advice({xtion}), Contains("/dev/bus/usb/998/999") && Contains("container"));
}

TEST_CASE("cannot_open_message: tells missing permission from a busy camera") {
  const std::string node = "/dev/bus/usb/001/007";
  CHECK_THAT(cannot_open_message("1d27/0601@1/7", node, UsbAccess::kDenied, "Failed to open"),
             Contains("may not write to " + node) && Contains("udev") && Contains("Failed to open"));
  CHECK_THAT(cannot_open_message("1d27/0601@1/7", node, UsbAccess::kAllowed, ""),
             Contains("another program") && Contains("fuser -v " + node));
  CHECK_THAT(cannot_open_message("1d27/0601@1/7", node, UsbAccess::kNoNode, ""), Contains("unplugged") && Contains("container"));
}

TEST_CASE("unknown_mode_message: lists what there is") {
  CHECK_THAT(unknown_mode_message("depth", {640, 480, 60, {}}, {{320, 240, 60, "depth 1 mm"}, {640, 480, 30, "depth 1 mm"}}),
             Contains("no depth mode of 640x480 at 60 Hz") && Contains("320x240 at 60 Hz (depth 1 mm), 640x480 at 30 Hz (depth 1 mm)"));
}

TEST_CASE("silence_message: tells apart what is missing") {
  CHECK_THAT(silence_message(false, false, 3000), Contains("nothing for 3.0 s"));
  CHECK_THAT(silence_message(false, true, 3000), Contains("colour but no depth"));
  CHECK_THAT(silence_message(true, false, 3000), Contains("depth but no colour"));
  CHECK_THAT(silence_message(true, true, 3000), Contains("pair_tolerance_ms"));
}

}  // namespace
}  // namespace foothold::test

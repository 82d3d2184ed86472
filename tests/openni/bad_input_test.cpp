// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// What users do wrong and what breaks: always a message that says what to do, and never a hang.
#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "foothold/openni/openni_source.h"
#include "support/catch.h"
#include "virtual_rig.h"

namespace foothold::test {
namespace {

using Catch::Matchers::Contains;

std::string temporary_file(const std::string& name) {
  return (std::filesystem::temp_directory_path() / ("foothold_openni_" + std::to_string(getpid()) + "_" + name)).string();
}

TEST_CASE("OpenNISource: settings out of range are refused before anything is opened") {
  OpenNISettings settings;
  settings.width = 8;
  CHECK_THROWS_AS(OpenNISource(settings), InvalidSettings);
  settings = {};
  settings.registration = "please";
  CHECK_THAT(message_of<InvalidSettings>([&] { OpenNISource{settings}; }), Contains("please") && Contains("auto, device, software or off"));
  settings.registration = "software";
  CHECK_THAT(message_of<InvalidSettings>([&] { OpenNISource{settings}; }), Contains("needs a calibration"));
  CHECK_THROWS_AS(OpenNISource({}, RgbdCalibration{}), InvalidSettings);
}

TEST_CASE("OpenNISource: without a camera, says what to check") {
  const VirtualRig rig{{"", "none"}};
  CHECK_THAT(message_of<DeviceError>([] { OpenNISource{rig_settings()}; }), Contains("no camera found"));
}

TEST_CASE("OpenNISource: an unknown camera is answered with those there are") {
  const VirtualRig rig;
  OpenNISettings settings = rig_settings();
  settings.device = GENERATE(as<std::string>{}, "7", "1d27/0601@1/7");
  CHECK_THAT(message_of<DeviceError>([&] { OpenNISource{settings}; }), Contains(settings.device) && Contains("foothold://0"));
}

TEST_CASE("OpenNISource: an unknown mode is answered with those there are") {
  const VirtualRig rig;
  OpenNISettings settings = rig_settings();
  settings.fps = 60;
  CHECK_THAT(message_of<InvalidSettings>([&] { OpenNISource{settings}; }),
             Contains("160x120 at 60 Hz") && Contains("160x120 at 30 Hz (depth 1 mm)") && Contains("80x60 at 30 Hz"));
}

TEST_CASE("OpenNISource: a webcam is no depth camera") {
  const VirtualRig rig{{"FEATURES", "no-depth"}};
  CHECK_THAT(message_of<DeviceError>([] { OpenNISource{rig_settings()}; }), Contains("no depth sensor"));
}

TEST_CASE("OpenNISource: insists on registration by the camera only if it is offered") {
  const VirtualRig rig{{"FEATURES", "no-registration"}};
  OpenNISettings settings = rig_settings();
  settings.registration = "device";
  CHECK_THAT(message_of<DeviceError>([&] { OpenNISource{settings}; }), Contains("does not offer registration"));
}

TEST_CASE("OpenNISource: a busy camera can be opened once it is free") {
  const std::string lock = temporary_file("lock");
  const VirtualRig rig{{"LOCK", lock}};
  const int descriptor = open(lock.c_str(), O_RDWR | O_CREAT, 0666);
  REQUIRE(descriptor >= 0);
  REQUIRE(flock(descriptor, LOCK_EX | LOCK_NB) == 0);
  CHECK_THAT(message_of<DeviceError>([] { OpenNISource{rig_settings()}; }), Contains("USB is busy") && Contains("another program"));
  close(descriptor);
  OpenNISource source(rig_settings());
  next_frame(source);
  std::filesystem::remove(lock);
}

TEST_CASE("OpenNISource: a sequence that the virtual camera cannot open is named") {
  const VirtualRig rig{{"", "pattern:tiny"}};
  CHECK_THAT(message_of<DeviceError>([] { OpenNISource{rig_settings()}; }), Contains("pattern:tiny"));
}

TEST_CASE("OpenNISource: recordings that are missing or damaged are refused in time") {
  const VirtualRig rig;
  OpenNISettings settings = rig_settings();
  settings.device = temporary_file("missing.oni");
  CHECK_THAT(message_of<FileError>([&] { OpenNISource{settings}; }), Contains("no such recording"));
  settings.device = temporary_file("damaged.oni");
  std::ofstream(settings.device) << "NI10 and then nothing of use";
  CHECK_THAT(message_of<FileError>([&] { OpenNISource{settings}; }), Contains("damaged.oni") && Contains("replay_sequence"));
  std::filesystem::remove(settings.device);
}

TEST_CASE("OpenNISource: says that OpenNI2 has no drivers", "[.][no-driver]") {
  CHECK_THAT(message_of<DeviceError>([] { OpenNISource{OpenNISettings{}}; }), Contains("no usable driver") && Contains("libopenni2-0"));
  CHECK_THAT(message_of<DeviceError>([] { list_openni_devices(); }), Contains("no usable driver"));
}

}  // namespace
}  // namespace foothold::test

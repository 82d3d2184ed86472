// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "usb.h"

#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "support/catch.h"

namespace foothold::test {
namespace {

using capture::UsbCamera;

/// A folder that looks like /sys/bus/usb/devices.
class FakeSysfs {
 public:
  FakeSysfs() : folder_(std::filesystem::temp_directory_path() / ("foothold_sysfs_" + std::to_string(getpid()))) {
    std::filesystem::create_directories(folder_);
  }
  ~FakeSysfs() { std::filesystem::remove_all(folder_); }
  void plug_in(const std::string& port, const std::string& vendor, const std::string& product, int bus, int address) {
    const std::filesystem::path device = folder_ / port;
    std::filesystem::create_directories(device);
    std::ofstream(device / "idVendor") << vendor << '\n';
    std::ofstream(device / "idProduct") << product << '\n';
    std::ofstream(device / "busnum") << bus << '\n';
    std::ofstream(device / "devnum") << address << '\n';
  }
  std::string path() const { return folder_.string(); }

 private:
  std::filesystem::path folder_;
};

TEST_CASE("find_usb_cameras: tells cameras from keyboards, and those with a driver from those without") {
  FakeSysfs sysfs;
  sysfs.plug_in("2-1", "045e", "02ae", 2, 3);
  sysfs.plug_in("1-4", "1d27", "0601", 1, 7);
  sysfs.plug_in("1-5", "046d", "c31c", 1, 8);  // a keyboard
  sysfs.plug_in("3-1", "8086", "0b07", 3, 2);
  std::filesystem::create_directories(std::filesystem::path(sysfs.path()) / "1-0:1.0");  // an interface has no identity of its own
  const auto cameras = capture::find_usb_cameras(sysfs.path());
  REQUIRE(cameras.size() == 3);
  CHECK(cameras[0].describe() == "PrimeSense, Xtion or Structure camera (1d27:0601, bus 1 device 7)");
  CHECK(cameras[0].support == UsbCamera::Support::kPrimeSense);
  CHECK(cameras[1].support == UsbCamera::Support::kKinect1);
  CHECK(cameras[2].support == UsbCamera::Support::kNone);
}

TEST_CASE("find_usb_cameras: a machine without USB has none") { CHECK(capture::find_usb_cameras("/nonexistent").empty()); }

TEST_CASE("parse_usb_uri: reads PrimeSense's URIs and no others") {
  int bus = 0;
  int address = 0;
  REQUIRE(capture::parse_usb_uri("1d27/0601@1/7", bus, address));
  CHECK(bus == 1);
  CHECK(address == 7);
  CHECK(capture::usb_node(bus, address) == "/dev/bus/usb/001/007");
  CHECK_FALSE(capture::parse_usb_uri("foothold://0", bus, address));
  CHECK_FALSE(capture::parse_usb_uri("1d27/0601@1/7/3", bus, address));
  CHECK_FALSE(capture::parse_usb_uri("", bus, address));
}

TEST_CASE("usb_access: tells a missing node from one that may be used") {
  FakeSysfs folder;
  const std::string node = folder.path() + "/node";
  CHECK(capture::usb_access(node) == capture::UsbAccess::kNoNode);
  std::ofstream(node) << "";
  CHECK(capture::usb_access(node) == capture::UsbAccess::kAllowed);
  if (geteuid() != 0) {  // root may everything
    std::filesystem::permissions(node, std::filesystem::perms::owner_read);
    CHECK(capture::usb_access(node) == capture::UsbAccess::kDenied);
  }
}

}  // namespace
}  // namespace foothold::test

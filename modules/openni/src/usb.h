// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// What the USB tells about depth cameras, whether or not OpenNI2 can drive them.
#pragma once

#include <string>
#include <vector>

namespace foothold::capture {

/// A depth camera on the USB.
struct UsbCamera {
  enum class Support {
    kPrimeSense,  ///< driven by the packaged PS1080 and PSLink drivers
    kKinect1,     ///< driven by libfreenect's OpenNI2 driver, which Debian does not package
    kNone,        ///< not an OpenNI2 camera on Debian
  };
  std::string model;
  Support support = Support::kNone;
  int vendor_id = 0;
  int product_id = 0;
  int bus = 0;
  int address = 0;

  /// Such as "PrimeSense, Xtion or Structure camera (1d27:0601, bus 1 device 7)".
  std::string describe() const;
};

/// The depth cameras among the devices in a sysfs folder.
std::vector<UsbCamera> find_usb_cameras(const std::string& sysfs = "/sys/bus/usb/devices");

/// Whether this user may use a device.
enum class UsbAccess { kAllowed, kDenied, kNoNode };

/// The device node of a bus and address, such as "/dev/bus/usb/001/007".
std::string usb_node(int bus, int address, const std::string& root = "/dev/bus/usb");

UsbAccess usb_access(const std::string& node);

/// Reads bus and address from a PrimeSense URI, "1d27/0601@1/7". @return False if it is none.
bool parse_usb_uri(const std::string& uri, int& bus, int& address);

}  // namespace foothold::capture

// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "usb.h"

#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <system_error>

namespace foothold::capture {
namespace {

/// USB identities of depth cameras; a product of -1 stands for all of the vendor's.
struct KnownCamera {
  int vendor_id;
  int product_id;
  UsbCamera::Support support;
  const char* model;
};
constexpr KnownCamera kKnownCameras[] = {
    {0x1d27, -1, UsbCamera::Support::kPrimeSense, "PrimeSense, Xtion or Structure camera"},
    {0x045e, 0x02ae, UsbCamera::Support::kKinect1, "Kinect for Xbox 360"},
    {0x045e, 0x02bf, UsbCamera::Support::kKinect1, "Kinect for Windows (first version)"},
    {0x045e, 0x02c4, UsbCamera::Support::kNone, "Kinect for Xbox One"},
    {0x045e, 0x02d8, UsbCamera::Support::kNone, "Kinect for Windows (second version)"},
    {0x045e, 0x097c, UsbCamera::Support::kNone, "Azure Kinect"},
    {0x8086, 0x0aa5, UsbCamera::Support::kNone, "RealSense SR300"},
    {0x8086, 0x0ad3, UsbCamera::Support::kNone, "RealSense D415"},
    {0x8086, 0x0b07, UsbCamera::Support::kNone, "RealSense D435"},
    {0x8086, 0x0b3a, UsbCamera::Support::kNone, "RealSense D435i"},
    {0x8086, 0x0b64, UsbCamera::Support::kNone, "RealSense L515"},
    {0x2bc5, -1, UsbCamera::Support::kNone, "Orbbec camera"},
};

/// The number in a small sysfs file; -1 if it cannot be read.
int read_number(const std::filesystem::path& file, int base) {
  std::ifstream stream(file);
  std::string text;
  if (!(stream >> text)) return -1;
  char* end = nullptr;
  const long value = std::strtol(text.c_str(), &end, base);
  return *end == '\0' ? static_cast<int>(value) : -1;
}

}  // namespace

std::string UsbCamera::describe() const {
  char identity[64];
  std::snprintf(identity, sizeof(identity), " (%04x:%04x, bus %d device %d)", static_cast<unsigned>(vendor_id),
                static_cast<unsigned>(product_id), bus, address);
  return model + identity;
}

std::vector<UsbCamera> find_usb_cameras(const std::string& sysfs) {
  std::vector<UsbCamera> cameras;
  std::error_code error;
  for (const auto& entry : std::filesystem::directory_iterator(sysfs, error)) {
    const int vendor = read_number(entry.path() / "idVendor", 16);
    const int product = read_number(entry.path() / "idProduct", 16);
    for (const KnownCamera& known : kKnownCameras) {
      if (vendor != known.vendor_id || (known.product_id != -1 && product != known.product_id)) continue;
      cameras.push_back({known.model, known.support, vendor, product, read_number(entry.path() / "busnum", 10),
                         read_number(entry.path() / "devnum", 10)});
      break;
    }
  }
  std::sort(cameras.begin(), cameras.end(),
            [](const UsbCamera& a, const UsbCamera& b) { return a.bus != b.bus ? a.bus < b.bus : a.address < b.address; });
  return cameras;
}

std::string usb_node(int bus, int address, const std::string& root) {
  char numbers[32];
  std::snprintf(numbers, sizeof(numbers), "/%03d/%03d", bus, address);
  return root + numbers;
}

UsbAccess usb_access(const std::string& node) {
  if (access(node.c_str(), F_OK) != 0) return UsbAccess::kNoNode;
  return access(node.c_str(), R_OK | W_OK) == 0 ? UsbAccess::kAllowed : UsbAccess::kDenied;
}

bool parse_usb_uri(const std::string& uri, int& bus, int& address) {
  unsigned vendor = 0;
  unsigned product = 0;
  int end = 0;
  return std::sscanf(uri.c_str(), "%4x/%4x@%d/%d%n", &vendor, &product, &bus, &address, &end) == 4 && end == static_cast<int>(uri.size());
}

}  // namespace foothold::capture

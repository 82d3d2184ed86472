// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "device_choice.h"

#include <algorithm>
#include <filesystem>
#include <system_error>

#include "messages.h"
#include "usb.h"

namespace foothold::capture {
namespace {

bool is_index(const std::string& device) {
  return !device.empty() && device.size() < 4 && device.find_first_not_of("0123456789") == std::string::npos;
}

}  // namespace

bool is_recording(const std::string& device) {
  const std::string ending = ".oni";
  return device.size() > ending.size() && device.compare(device.size() - ending.size(), ending.size(), ending) == 0;
}

std::string choose_device(const std::string& wanted, const std::vector<OpenNIDeviceInfo>& devices) {
  if (is_recording(wanted)) {
    std::error_code error;
    if (!std::filesystem::is_regular_file(wanted, error)) throw FileError(wanted + ": no such recording");
    return std::filesystem::absolute(wanted).string();
  }
  if (devices.empty()) throw DeviceError(no_device_advice(find_usb_cameras()));
  if (wanted.empty()) return devices.front().uri;
  if (is_index(wanted)) {
    const std::size_t index = std::stoul(wanted);
    if (index < devices.size()) return devices[index].uri;
  }
  for (const OpenNIDeviceInfo& device : devices) {
    if (device.uri == wanted) return device.uri;
  }
  throw DeviceError(unknown_device_message(wanted, devices));
}

std::string find_again(const OpenNIDeviceInfo& lost, const std::vector<OpenNIDeviceInfo>& devices,
                       const std::vector<std::string>& newcomers, bool any_model) {
  std::string same;
  std::string other;
  for (const OpenNIDeviceInfo& device : devices) {
    if (device.uri == lost.uri) return device.uri;
    if (std::find(newcomers.begin(), newcomers.end(), device.uri) == newcomers.end()) continue;
    const bool same_model = device.vendor == lost.vendor && device.name == lost.name && device.usb_product_id == lost.usb_product_id;
    (same_model ? same : other) = device.uri;
  }
  return !same.empty() || !any_model ? same : other;
}

}  // namespace foothold::capture

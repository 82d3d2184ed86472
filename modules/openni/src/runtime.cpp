// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "runtime.h"

#include <mutex>
#include <utility>

#include "messages.h"

namespace foothold::capture {
namespace {

/// Never destroyed: a thread that a driver has swallowed may still use it while the process exits.
struct Users {
  std::mutex mutex;
  int count = 0;
};
Users& users() {
  static auto* users = new Users;
  return *users;
}

std::string format_name(openni::PixelFormat format) {
  switch (format) {
    case openni::PIXEL_FORMAT_DEPTH_1_MM:
      return "depth 1 mm";
    case openni::PIXEL_FORMAT_DEPTH_100_UM:
      return "depth 0.1 mm";
    case openni::PIXEL_FORMAT_SHIFT_9_2:
    case openni::PIXEL_FORMAT_SHIFT_9_3:
      return "raw disparity";
    case openni::PIXEL_FORMAT_RGB888:
      return "RGB 8 bit";
    case openni::PIXEL_FORMAT_YUV422:
    case openni::PIXEL_FORMAT_YUYV:
      return "YUV 4:2:2";
    case openni::PIXEL_FORMAT_GRAY8:
      return "grey 8 bit";
    case openni::PIXEL_FORMAT_GRAY16:
      return "grey 16 bit";
    case openni::PIXEL_FORMAT_JPEG:
      return "JPEG";
  }
  return "format " + std::to_string(static_cast<int>(format));
}

}  // namespace

Runtime::Runtime() {
  const std::lock_guard<std::mutex> lock(users().mutex);
  if (users().count == 0 && openni::OpenNI::initialize() != openni::STATUS_OK) {
    const std::string error = openni_error();
    openni::OpenNI::shutdown();  // OpenNI2 counts failed initialisations too
    throw DeviceError(no_driver_message(error));
  }
  ++users().count;
}

Runtime::~Runtime() {
  const std::lock_guard<std::mutex> lock(users().mutex);
  if (--users().count == 0) openni::OpenNI::shutdown();
}

std::vector<OpenNIDeviceInfo> Runtime::devices() const {
  openni::Array<openni::DeviceInfo> found;
  openni::OpenNI::enumerateDevices(&found);
  std::vector<OpenNIDeviceInfo> devices;
  for (int i = 0; i < found.getSize(); ++i) devices.push_back(to_info(found[i]));
  return devices;
}

std::string openni_error() {
  std::string text = openni::OpenNI::getExtendedError();
  while (!text.empty() && (text.back() == '\n' || text.back() == '\t' || text.back() == ' ')) text.pop_back();
  std::string line;
  for (const char c : text) {
    if (c == '\n') {
      line += "; ";
    } else if (c != '\t') {
      line += c;
    }
  }
  return line;
}

OpenNIDeviceInfo to_info(const openni::DeviceInfo& info) {
  OpenNIDeviceInfo result;
  result.uri = info.getUri();
  result.vendor = info.getVendor();
  result.name = info.getName();
  result.usb_vendor_id = info.getUsbVendorId();
  result.usb_product_id = info.getUsbProductId();
  return result;
}

std::vector<OpenNIVideoMode> video_modes(openni::Device& device, openni::SensorType sensor) {
  std::vector<OpenNIVideoMode> modes;
  const openni::SensorInfo* info = device.getSensorInfo(sensor);
  if (info == nullptr) return modes;
  const openni::Array<openni::VideoMode>& offered = info->getSupportedVideoModes();
  for (int i = 0; i < offered.getSize(); ++i) {
    modes.push_back(
        {offered[i].getResolutionX(), offered[i].getResolutionY(), offered[i].getFps(), format_name(offered[i].getPixelFormat())});
  }
  return modes;
}

HotplugListener::HotplugListener(Callbacks callbacks) : callbacks_(std::move(callbacks)) {
  openni::OpenNI::addDeviceConnectedListener(this);
  openni::OpenNI::addDeviceDisconnectedListener(this);
  openni::OpenNI::addDeviceStateChangedListener(this);
}

HotplugListener::~HotplugListener() {
  openni::OpenNI::removeDeviceStateChangedListener(this);
  openni::OpenNI::removeDeviceDisconnectedListener(this);
  openni::OpenNI::removeDeviceConnectedListener(this);
}

void HotplugListener::onDeviceConnected(const openni::DeviceInfo* info) { callbacks_.connected(info->getUri()); }
void HotplugListener::onDeviceDisconnected(const openni::DeviceInfo* info) { callbacks_.disconnected(info->getUri()); }
void HotplugListener::onDeviceStateChanged(const openni::DeviceInfo* info, openni::DeviceState state) {
  if (state == openni::DEVICE_STATE_EOF) callbacks_.ended(info->getUri());
}

}  // namespace foothold::capture

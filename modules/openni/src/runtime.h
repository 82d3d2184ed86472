// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// OpenNI2's process-wide state, shared by the sources of a process.
#pragma once

#include <OpenNI.h>

#include <functional>
#include <string>
#include <vector>

#include "foothold/openni/openni_source.h"

namespace foothold::capture {

/// Keeps OpenNI2 initialised while it lives. The library has one state per process, so the objects count themselves: the first initialises,
/// the last shuts down.
///
/// Initialising changes the process's working directory for a moment (OpenNI2 loads its drivers so).
class Runtime {
 public:
  /// @throws DeviceError if OpenNI2 finds no driver.
  Runtime();
  ~Runtime();
  Runtime(const Runtime&) = delete;
  Runtime& operator=(const Runtime&) = delete;

  /// The cameras that are plugged in, without their modes.
  std::vector<OpenNIDeviceInfo> devices() const;
};

/// OpenNI2's own words about this thread's last error, on one line.
std::string openni_error();

OpenNIDeviceInfo to_info(const openni::DeviceInfo& info);

/// The modes of a sensor; empty if the device has no such sensor.
std::vector<OpenNIVideoMode> video_modes(openni::Device& device, openni::SensorType sensor);

/// Calls back when cameras come and go, from a thread of the driver's. The callbacks must not call OpenNI2.
class HotplugListener : private openni::OpenNI::DeviceConnectedListener,
                        private openni::OpenNI::DeviceDisconnectedListener,
                        private openni::OpenNI::DeviceStateChangedListener {
 public:
  struct Callbacks {
    std::function<void(const std::string& uri)> connected;
    std::function<void(const std::string& uri)> disconnected;
    std::function<void(const std::string& uri)> ended;  ///< a recording is over
  };
  /// @pre A Runtime lives longer.
  explicit HotplugListener(Callbacks callbacks);
  ~HotplugListener() override;

 private:
  void onDeviceConnected(const openni::DeviceInfo* info) override;
  void onDeviceDisconnected(const openni::DeviceInfo* info) override;
  void onDeviceStateChanged(const openni::DeviceInfo* info, openni::DeviceState state) override;

  Callbacks callbacks_;
};

}  // namespace foothold::capture

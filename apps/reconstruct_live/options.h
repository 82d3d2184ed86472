// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// The command line of reconstruct_live.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "common/app_main.h"
#include "foothold/openni/openni_source.h"

namespace foothold::live {

/// Every setting that the app can change.
struct LiveSettings {
  OpenNISettings camera;

  template <class Visitor>
  static void fields(Visitor& v) {
    v(&LiveSettings::camera, "camera");
  }
};

/// As typed.
struct LiveOptions {
  bool list_devices = false;
  std::string camera;
  std::string mode = "640x480@30";
  std::string calibration_folder;
  std::string settings_file;
  std::vector<std::string> settings;
  std::string record_folder;
  int num_frames = 0;  ///< stop after so many; 0 for no limit
};

void add_live_options(CLI::App& app, LiveOptions& options);

/// The settings: --mode and --camera, then the settings file, then --set. @throws InvalidSettings, FileError
LiveSettings live_settings(const LiveOptions& options);

/// The calibration that --calibration names, if any. @throws FileError
std::optional<RgbdCalibration> camera_calibration(const LiveOptions& options);

/// What --list-devices prints.
std::string describe_devices(const std::vector<OpenNIDeviceInfo>& devices);

}  // namespace foothold::live

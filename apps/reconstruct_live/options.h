// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// The command line of reconstruct_live.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "common/app_main.h"
#include "foothold/openni/openni_source.h"
#include "foothold/reconstruction/reconstruction.h"

namespace foothold::live {

/// Every setting that the app can change.
struct LiveSettings : ReconstructionSettings {
  /// The camera is waited for in short steps, so that keys are heeded meanwhile.
  LiveSettings() { camera.read_timeout_ms = 50; }

  OpenNISettings camera;

  template <class Visitor>
  static void fields(Visitor& v) {
    v(&LiveSettings::camera, "camera");
    ReconstructionSettings::fields(v);
  }
  /// @throws InvalidSettings
  void validate() const;
};

/// A key pressed by the command line.
struct ScriptedKey {
  char key = 0;
  int frame = 0;  ///< before this one, counted from 0
};

/// As typed.
struct LiveOptions {
  bool list_devices = false;
  std::string camera;
  std::string mode;  ///< empty for the default
  bool fast = false;
  std::string colour_mode;  ///< empty for the size of --mode
  std::string calibration_folder;
  std::string settings_file;
  std::vector<std::string> settings;
  std::string forest;
  apps::DeviceOptions device;

  std::string record_folder;
  bool record_only = false;
  bool headless = false;
  std::string view_folder;
  int view_every = 30;  ///< frames
  int num_frames = 0;   ///< stop after so many; 0 for no limit
  double duration_s = 0.0;
  std::vector<std::string> keys;

  std::string load_scene;
  std::string save_scene;
  std::string save_mesh;
  std::string save_trajectory;
  std::string json;
};

void add_live_options(apps::CommandLine& app, LiveOptions& options);

/// The settings: --mode, --colour-mode and --camera, then the settings file, then --set. @throws InvalidSettings, FileError
LiveSettings live_settings(const LiveOptions& options);

/// The calibration that --calibration names, if any. @throws FileError
std::optional<RgbdCalibration> camera_calibration(const LiveOptions& options);

/// What --press asks for, by rising frame. @throws InvalidSettings
std::vector<ScriptedKey> scripted_keys(const std::vector<std::string>& texts);

/// @throws InvalidSettings for options that exclude each other; FileError for a file that could not be written in the end.
void check_options(const LiveOptions& options);

/// What --list-devices prints.
std::string describe_devices(const std::vector<OpenNIDeviceInfo>& devices);

}  // namespace foothold::live

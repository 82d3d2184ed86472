// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "options.h"

#include <cstdio>
#include <set>

#include "foothold/base/error.h"
#include "foothold/io/calibration.h"
#include "foothold/io/settings_file.h"

namespace foothold::live {
namespace {

/// Reads "640x480@30" or "640x480". @throws InvalidSettings
void assign_mode(const std::string& mode, OpenNISettings& settings) {
  int end = 0;
  const char* text = mode.c_str();
  const bool with_rate = std::sscanf(text, "%dx%d@%d%n", &settings.width, &settings.height, &settings.fps, &end) == 3;
  const bool without = !with_rate && std::sscanf(text, "%dx%d%n", &settings.width, &settings.height, &end) == 2;
  if ((with_rate || without) && end == static_cast<int>(mode.size())) return;
  throw InvalidSettings("--mode: got '" + mode + "', expected WIDTHxHEIGHT@FPS, such as 640x480@30");
}

/// Modes in words, each once.
std::string mode_list(const std::vector<OpenNIVideoMode>& modes) {
  std::set<std::string> listed;
  std::string text;
  for (const OpenNIVideoMode& mode : modes) {
    const std::string name =
        std::to_string(mode.width) + "x" + std::to_string(mode.height) + "@" + std::to_string(mode.fps) + " (" + mode.format + ")";
    if (listed.insert(name).second) text += (text.empty() ? "" : ", ") + name;
  }
  return text;
}

}  // namespace

void add_live_options(CLI::App& app, LiveOptions& options) {
  app.add_flag("--list-devices", options.list_devices, "List the cameras and their modes, and end");
  app.add_option("--camera", options.camera, "The camera: an index or a URI of --list-devices, or an .oni file; otherwise the first");
  app.add_option("--mode", options.mode, "Size and rate of depth and colour, as WIDTHxHEIGHT@FPS")->capture_default_str();
  app.add_option("--calibration", options.calibration_folder,
                 "Folder with camera-intrinsics.txt and the like (docs/sequences.md); otherwise the camera's own field of view")
      ->type_name("DIR");
  app.add_option("--settings", options.settings_file, "JSON file of settings: {\"camera\": {\"lock_exposure\": true}}");
  app.add_option("--set", options.settings, "One setting as path=value, such as camera.lock_exposure=true; repeatable")->take_all();
  app.add_option("--record", options.record_folder, "Record what the camera sends in the layout of 7-Scenes")->type_name("DIR");
  app.add_option("--frames", options.num_frames, "Stop after this many frames; 0 for no limit")
      ->check(CLI::Range(0, 100000000))
      ->capture_default_str();
}

LiveSettings live_settings(const LiveOptions& options) {
  LiveSettings settings;
  assign_mode(options.mode, settings.camera);
  settings.camera.device = options.camera;
  if (!options.settings_file.empty()) load_settings(options.settings_file, settings);
  for (const std::string& assignment : options.settings) {
    const std::size_t equals = assignment.find('=');
    if (equals == std::string::npos || equals == 0) {
      throw InvalidSettings("--set: got '" + assignment + "', expected path=value, such as camera.lock_exposure=true");
    }
    assign_setting(settings, assignment.substr(0, equals), assignment.substr(equals + 1));
  }
  settings.camera.validate();
  return settings;
}

std::optional<RgbdCalibration> camera_calibration(const LiveOptions& options) {
  if (options.calibration_folder.empty()) return std::nullopt;
  return read_calibration(options.calibration_folder);
}

std::string describe_devices(const std::vector<OpenNIDeviceInfo>& devices) {
  std::string text;
  for (std::size_t i = 0; i < devices.size(); ++i) {
    const OpenNIDeviceInfo& device = devices[i];
    text += std::to_string(i) + "  " + device.uri + "  " + device.vendor + " " + device.name + "\n";
    if (device.depth_modes.empty()) {
      text += "   cannot be opened now: another program may be using it, or you may not\n";
      continue;
    }
    text += "   depth:  " + mode_list(device.depth_modes) + "\n";
    text += "   colour: " + (device.colour_modes.empty() ? "none" : mode_list(device.colour_modes)) + "\n";
  }
  return text;
}

}  // namespace foothold::live

// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "options.h"

#include <algorithm>
#include <cstdio>
#include <set>

#include "common/override_settings.h"
#include "foothold/base/atomic_file.h"
#include "foothold/base/error.h"
#include "foothold/io/calibration.h"

namespace foothold::live {
namespace {

constexpr const char* kMode = "640x480@30";  ///< what all cameras offer
constexpr const char* kFastMode = "320x240@30";
constexpr float kFastVoxelM = 0.02F;

/// Reads "640x480@30" or "640x480". @throws InvalidSettings
void assign_mode(const std::string& mode, OpenNISettings& settings) {
  int end = 0;
  const char* text = mode.c_str();
  const bool with_rate = std::sscanf(text, "%dx%d@%d%n", &settings.width, &settings.height, &settings.fps, &end) == 3;
  const bool without = !with_rate && std::sscanf(text, "%dx%d%n", &settings.width, &settings.height, &end) == 2;
  if ((with_rate || without) && end == static_cast<int>(mode.size())) return;
  throw InvalidSettings("--mode: got '" + mode + "', expected WIDTHxHEIGHT@FPS, such as 640x480@30");
}

/// Reads "640x480". @throws InvalidSettings
void assign_colour_mode(const std::string& mode, OpenNISettings& settings) {
  int end = 0;
  const bool is_read = std::sscanf(mode.c_str(), "%4dx%4d%n", &settings.colour_width, &settings.colour_height, &end) == 2;
  if (is_read && end == static_cast<int>(mode.size()) && settings.colour_width > 0 && settings.colour_height > 0) return;
  throw InvalidSettings("--colour-mode: got '" + mode + "', expected WIDTHxHEIGHT, such as 640x480");
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

void LiveSettings::validate() const {
  camera.validate();
  ReconstructionSettings::validate();
}

void add_live_options(apps::CommandLine& app, LiveOptions& options) {
  app.add_flag("--list-devices", options.list_devices, "List the cameras and their modes, and end");
  app.add_option("--camera", options.camera, "The camera: an index or a URI of --list-devices, or an .oni file; otherwise the first");
  app.add_option("--mode", options.mode,
                 std::string("Size and rate of depth and colour, as WIDTHxHEIGHT@FPS; otherwise ") + kMode + ", with --fast " + kFastMode);
  app.add_flag("--fast", options.fast, "For slow machines: smaller images and voxels of 2 cm, unless --mode or settings say otherwise");
  app.add_option("--colour-mode", options.colour_mode, "Size of colour, if it is another, as WIDTHxHEIGHT");
  app.add_option("--calibration", options.calibration_folder,
                 "Folder with camera-intrinsics.txt and the like (docs/sequences.md); otherwise the camera's own field of view")
      .type_name("DIR");
  app.add_option("--forest", options.forest, "A forest file; otherwise the one that comes with Foothold").type_name("FILE");
  app.add_option("--settings", options.settings_file, "JSON file of settings: {\"camera\": {\"lock_exposure\": true}}").type_name("FILE");
  app.add_option("--set", options.settings,
                 "One setting as path=value, such as camera.lock_exposure=true or fusion.volume.voxel_size_m=0.02; repeatable")
      .repeatable();
  apps::add_device_options(app, options.device);

  app.add_option("--load-scene", options.load_scene, "Go on with a saved scene: the camera is looked for in it").type_name("FILE");
  app.add_option("--save-scene", options.save_scene, "Save the scene at the end: map, relocaliser and settings").type_name("FILE");
  app.add_option("--save-mesh", options.save_mesh, "Save the surface at the end, as PLY").type_name("FILE");
  app.add_option("--save-trajectory", options.save_trajectory, "Save the camera's poses at the end, in the format of TUM")
      .type_name("FILE");
  app.add_option("--json", options.json, "Save a summary of the run at the end").type_name("FILE");

  app.add_option("--record", options.record_folder,
                 "Record the frames that are reconstructed, in the layout of 7-Scenes: replay_sequence then gives the same trajectory")
      .type_name("DIR");
  app.add_flag("--record-only", options.record_only, "With --record: record every frame of the camera, and reconstruct nothing");
  app.add_flag("--headless", options.headless, "Open no window");
  app.add_option("--view-dir", options.view_folder, "Write the view as PNG files into this folder").type_name("DIR");
  app.add_option("--view-every", options.view_every, "Write the view after every so many frames").range(1, 1000000).show_default();
  app.add_option("--frames", options.num_frames, "Stop after this many frames; 0 for no limit").range(0, 100000000).show_default();
  app.add_option("--duration", options.duration_s, "Stop after this many seconds; 0 for no limit").range(0.0, 1e9).show_default();
  app.add_option("--press", options.keys, "Press a key of the window before a frame, as KEY@FRAME, such as l@100; repeatable").repeatable();
}

LiveSettings live_settings(const LiveOptions& options) {
  LiveSettings settings;
  assign_mode(!options.mode.empty() ? options.mode : options.fast ? kFastMode : kMode, settings.camera);
  if (options.fast) settings.fusion.volume.voxel_size_m = kFastVoxelM;
  if (!options.colour_mode.empty()) assign_colour_mode(options.colour_mode, settings.camera);
  settings.camera.device = options.camera;
  apps::override_settings(options.settings_file, options.settings, "path=value, such as camera.lock_exposure=true", settings);
  settings.validate();
  return settings;
}

std::optional<RgbdCalibration> camera_calibration(const LiveOptions& options) {
  if (options.calibration_folder.empty()) return std::nullopt;
  return read_calibration(options.calibration_folder);
}

std::vector<ScriptedKey> scripted_keys(const std::vector<std::string>& texts) {
  std::vector<ScriptedKey> keys;
  for (const std::string& text : texts) {
    ScriptedKey key;
    int end = 0;
    const bool is_read = std::sscanf(text.c_str(), "%c@%9d%n", &key.key, &key.frame, &end) == 2;
    if (!is_read || end != static_cast<int>(text.size()) || key.frame < 0) {
      throw InvalidSettings("--press: got '" + text + "', expected KEY@FRAME, such as l@100");
    }
    keys.push_back(key);
  }
  std::stable_sort(keys.begin(), keys.end(), [](const ScriptedKey& a, const ScriptedKey& b) { return a.frame < b.frame; });
  return keys;
}

void check_options(const LiveOptions& options) {
  if (options.record_only) {
    if (options.record_folder.empty()) throw InvalidSettings("--record-only: says how to record; give --record DIR as well");
    for (const std::string* output : {&options.load_scene, &options.save_scene, &options.save_mesh, &options.save_trajectory}) {
      if (!output->empty())
        throw InvalidSettings("--record-only: nothing is reconstructed, so there is no '" + *output + "' to read or write");
    }
  }
  // A long run should not end with a folder that does not exist.
  for (const std::string* output : {&options.save_scene, &options.save_mesh, &options.save_trajectory, &options.json}) {
    if (!output->empty()) expect_writable(*output);
  }
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

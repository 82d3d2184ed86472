// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// Settings in JSON files: one object, nested where setting paths have dots. {"pose": {"num_hypotheses": 512}} sets pose.num_hypotheses.
#pragma once

#include <string>
#include <vector>

#include "foothold/base/settings.h"

namespace foothold {

/// One leaf of a settings file.
struct SettingText {
  std::string path;  ///< e.g. "pose.num_hypotheses"
  std::string text;  ///< as assign_setting() takes it
};

/// The leaves of a settings file in its order.
/// @throws FileError for a missing file or bad JSON (with the place); InvalidSettings naming the file for a list, null or repeated key.
std::vector<SettingText> read_settings_file(const std::string& path);

/// Settings as JSON, with every field in its place. Text fields are those whose description has no range.
std::string settings_to_json(const std::vector<SettingDescription>& settings);

/// Overrides the settings that a file names; on failure none of them.
/// @throws as read_settings_file(), and InvalidSettings naming the file and an unknown key (with the nearest known one) or a bad value.
template <class Settings>
void load_settings(const std::string& path, Settings& settings) {
  Settings result = settings;
  for (const SettingText& setting : read_settings_file(path)) {
    try {
      assign_setting(result, setting.path, setting.text);
    } catch (const InvalidSettings& error) {
      throw InvalidSettings(path + ": " + error.what());
    }
  }
  settings = result;
}

/// Writes text in one piece, or leaves the old file. For save_settings(). @throws FileError
void write_settings_text(const std::string& path, const std::string& text);

/// Writes all settings to a file that load_settings() reads back exactly. @throws FileError
template <class Settings>
void save_settings(const std::string& path, const Settings& settings) {
  write_settings_text(path, settings_to_json(describe_settings(settings)));
}

}  // namespace foothold

// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// What --settings FILE and --set PATH=VALUE do in every app.
#pragma once

#include <string>
#include <vector>

#include "foothold/base/settings.h"
#include "foothold/files/settings_file.h"

namespace foothold::apps {

/// Overrides settings by a file, if there is one, then by assignments "path=value", in their order. Validates ranges only.
/// @param expected  How an assignment looks, for the message about one that does not.
/// @throws InvalidSettings, FileError
template <class Settings>
void override_settings(const std::string& file, const std::vector<std::string>& assignments, const std::string& expected,
                       Settings& settings) {
  if (!file.empty()) load_settings(file, settings);
  for (const std::string& assignment : assignments) {
    const std::size_t equals = assignment.find('=');
    if (equals == std::string::npos || equals == 0) throw InvalidSettings("--set: got '" + assignment + "', expected " + expected);
    assign_setting(settings, assignment.substr(0, equals), assignment.substr(equals + 1));
  }
}

}  // namespace foothold::apps

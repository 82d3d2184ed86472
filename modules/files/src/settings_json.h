// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#pragma once

#include <string>
#include <vector>

#include "foothold/files/settings_file.h"

namespace foothold::files {

/// read_settings_file() of a text already in memory.
std::vector<SettingText> parse_settings_json(const std::string& text, const std::string& file);

}  // namespace foothold::files

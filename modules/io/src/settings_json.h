// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#pragma once

#include <string>
#include <vector>

#include "foothold/io/settings_file.h"

namespace foothold::io {

/// read_settings_file() of a text already in memory.
std::vector<SettingText> parse_settings_json(const std::string& text, const std::string& file);

}  // namespace foothold::io

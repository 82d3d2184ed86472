// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// Text of files and users, as messages and terminals may show it.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "foothold/base/platform.h"

namespace foothold {

/// Replaces control characters, such as a terminal's escapes, and bytes beyond ASCII by `\xNN`.
/// @param max_characters  What follows them is cut off and shown as "...".
std::string printable(std::string_view text, std::size_t max_characters = 80);

/// Text from outside, made fit for a message: quoted, without control characters, and cut when long.
std::string in_quotes(std::string_view text);

}  // namespace foothold

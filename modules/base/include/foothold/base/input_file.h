// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// Reading files whole, with messages that name file, value and expectation.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>

#include "foothold/base/error.h"

namespace foothold {

/// Throws FileError "file: got <found>, expected <expected>".
[[noreturn]] void throw_file_error(const std::filesystem::path& file, const std::string& found, const std::string& expected);

/// The bytes of a file. @throws FileError if it is no regular file (pipes and devices may never end), cannot be opened, or is larger than
/// `max_bytes`.
std::string read_file(const std::filesystem::path& file, std::size_t max_bytes);

}  // namespace foothold

// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#pragma once

#include <filesystem>
#include <string_view>

#include "foothold/io/mesh_file.h"

namespace foothold::io {

/// read_ply() of bytes already in memory.
Mesh parse_ply(std::string_view bytes, const std::filesystem::path& file);

}  // namespace foothold::io

// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// Images from the bytes of a file, wherever these come from.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "foothold/base/image.h"

namespace foothold::io {

/// Largest size of an image file [bytes].
inline constexpr std::size_t kMaxImageBytes = 512U << 20U;

/// read_rgb_image() of bytes already in memory. @param name  what messages call them.
Image<Rgb8> decode_rgb(std::string bytes, const std::filesystem::path& name);
/// read_u16_image() of bytes already in memory.
Image<std::uint16_t> decode_u16(std::string bytes, const std::filesystem::path& name);

}  // namespace foothold::io

// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// Images from the bytes of a file, wherever these come from.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "foothold/base/error.h"
#include "foothold/base/image.h"

namespace foothold::io {

/// Largest size of an image file [bytes].
inline constexpr std::size_t kMaxImageBytes = 512U << 20U;

/// The error of an image that is whole, but of another kind or size than expected.
class OtherImage : public FileError {
 public:
  OtherImage(const std::filesystem::path& file, const std::string& found, const std::string& expected)
      : FileError(file.string() + ": got " + found + ", expected " + expected) {}
};

/// Looks at the beginning and the end of an image file. @throws FileError if it is missing, empty, cut short, or no image that is read.
void check_image_file(const std::filesystem::path& file);

/// read_rgb_image() of bytes already in memory. @param name  what messages call them.
Image<Rgb8> decode_rgb(std::string bytes, const std::filesystem::path& name);
/// read_u16_image() of bytes already in memory.
Image<std::uint16_t> decode_u16(std::string bytes, const std::filesystem::path& name);

}  // namespace foothold::io

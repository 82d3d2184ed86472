// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// Depth in EXR images: one channel of floating-point numbers. Reference: the OpenEXR file layout.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

#include "foothold/base/image.h"
#include "image_header.h"

namespace foothold::io {

/// What an EXR image tells before its pixels.
struct ExrHeader {
  ImageSize size;
  std::string channel;         ///< the one with depth
  std::size_t num_bytes = 0;   ///< of the header; the places of the chunks follow
  std::size_t num_chunks = 0;  ///< each of some lines
};

/// Parses the head of an EXR image of scan lines. Of several channels, depth is the one called Z, depth, Y or R.
/// @throws FileError if it is damaged, or not a single part of scan lines with one of these channels, of a size that is decoded.
ExrHeader parse_exr_header(std::string_view bytes, const std::filesystem::path& name);

/// Looks at the beginning of a file: header, and whether all chunks begin within the file. @throws FileError
void check_exr_file(const std::filesystem::path& file);

/// True if this build was configured with OpenEXR.
bool reads_exr();

/// Decodes depth in the file's own unit, whatever its numbers are: also NaN. @throws FileError
Image<float> decode_exr(const std::string& bytes, const std::filesystem::path& name);

}  // namespace foothold::io

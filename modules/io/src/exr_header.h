// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// What the first bytes of an EXR image tell, before memory is taken for its pixels. Reference: the OpenEXR file layout.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

#include "image_header.h"

namespace foothold::io {

/// What an EXR image tells before its pixels.
struct ExrHeader {
  ImageSize size;
  std::array<std::int32_t, 4> window{};  ///< left, top, right, bottom: the last ones included
  std::string channel;                   ///< the one with depth
  std::string channels;                  ///< all of them, as the file lists them
  char compression = 0;
  std::size_t num_bytes = 0;   ///< of the header; the places of the chunks follow
  std::size_t num_chunks = 0;  ///< each of some lines
};

/// Parses the head of an EXR image of scan lines. Of several channels, depth is the one called Z, depth, Y or R.
/// @throws FileError if it is damaged, or not a single part of scan lines with one of these channels, of a size that is decoded.
ExrHeader parse_exr_header(std::string_view bytes, const std::filesystem::path& name);

/// The same, and requires that all chunks begin within a file of some size. @throws FileError
ExrHeader parse_exr_head(std::string_view bytes, std::uintmax_t file_size, const std::filesystem::path& name);

/// Looks at the beginning of a file: header, and whether all chunks begin within the file. @throws FileError
void check_exr_file(const std::filesystem::path& file);

}  // namespace foothold::io

// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// Images without a format of their own, as containers hold them.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "foothold/base/image.h"
#include "found_recording.h"

namespace foothold::io {

/// Inflates a zlib stream of exactly `num_bytes` bytes. @return Empty if it is damaged or of another length.
std::string inflate(std::string_view bytes, std::size_t num_bytes);

/// Depth as rows of little-endian 16-bit numbers. @throws FileError if the bytes are not exactly those of an image of the size.
Image<std::uint16_t> decode_raw_depth(const std::string& bytes, const StoredImage& stored, const ImageSize& size);
/// Colour as rows of R, G and B.
Image<Rgb8> decode_raw_colour(const std::string& bytes, const StoredImage& stored, const ImageSize& size);

}  // namespace foothold::io

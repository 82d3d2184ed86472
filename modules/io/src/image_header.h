// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// What the first bytes of an image file tell, before memory is taken for its pixels.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace foothold::io {

struct ImageSize {
  int width = 0;
  int height = 0;
  bool operator==(const ImageSize& other) const { return width == other.width && height == other.height; }
  bool operator!=(const ImageSize& other) const { return !(*this == other); }
  bool empty() const { return width <= 0 || height <= 0; }
};

/// Such as "640x480".
std::string to_string(const ImageSize& size);

/// True if one size is the other enlarged, to within 1 % of a side.
bool same_shape(const ImageSize& a, const ImageSize& b);

struct ImageHeader {
  ImageSize size;
  int num_channels = 0;
  int bits_per_channel = 0;
};

/// Most pixels of an image that is decoded: several times what colour cameras of depth sensors have.
inline constexpr int kMaxImagePixels = 32 << 20;

/// Parses the head of a PNG, JPEG or binary PGM or PPM image. @return Empty for anything else.
std::optional<ImageHeader> parse_image_header(std::string_view bytes);

}  // namespace foothold::io

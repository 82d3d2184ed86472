// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// Heads of images: sizes are within bounds, and small images decode or are refused.
#include "fuzz.h"
#include "image_decoding.h"
#include "image_header.h"

FOOTHOLD_FUZZ_TARGET(image) {
  using namespace foothold;
  const std::string bytes = fuzz::text_of(data, size);
  const std::optional<io::ImageHeader> header = io::parse_image_header(bytes);
  if (!header.has_value()) return 0;
  fuzz::require(!header->size.empty() && header->num_channels > 0 && header->bits_per_channel > 0);
  constexpr std::int64_t kMaxPixels = 1 << 16;  // larger images take long to clear
  if (std::int64_t{header->size.width} * header->size.height > kMaxPixels) return 0;
  fuzz::attempt([&] { fuzz::require(io::decode_u16(bytes, "depth.png").width() == header->size.width); });
  fuzz::attempt([&] { fuzz::require(io::decode_rgb(bytes, "colour.png").height() == header->size.height); });
  return 0;
}

// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// EXR images: what a header announces is of a size that is decoded, and small ones decode or are refused.
#include "exr_header.h"
#include "exr_image.h"
#include "fuzz.h"

FOOTHOLD_FUZZ_TARGET(exr) {
  using namespace foothold;
  const std::string bytes = fuzz::text_of(data, size);
  fuzz::attempt([&] {
    const io::ExrHeader header = io::parse_exr_header(bytes, "0.exr");
    const long num_pixels = long{header.size.width} * header.size.height;
    fuzz::require(num_pixels >= 1 && num_pixels <= io::kMaxImagePixels);
    fuzz::require(header.num_bytes <= size && header.num_chunks >= 1 && header.num_chunks <= static_cast<std::size_t>(header.size.height));
    constexpr long kMaxPixels = 1 << 16;  // larger images take long to clear
    if (!io::reads_exr() || num_pixels > kMaxPixels) return;
    const Image<float> image = io::decode_exr(bytes, "0.exr");
    fuzz::require(image.width() == header.size.width && image.height() == header.size.height);
  });
  return 0;
}

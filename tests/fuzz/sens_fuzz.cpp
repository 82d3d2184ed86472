// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// .sens files: every image that is announced lies within the file, and unpacks or is refused.
#include <algorithm>
#include <sstream>

#include "fuzz.h"
#include "raw_image.h"
#include "sens_file.h"

FOOTHOLD_FUZZ_TARGET(sens) {
  using namespace foothold;
  const std::string bytes = fuzz::text_of(data, size);
  fuzz::attempt([&] {
    std::istringstream stream(bytes);
    const io::SensContents contents = io::parse_sens(stream, "scene.sens");
    fuzz::require(is_valid(contents.depth.intrinsics) && is_valid(contents.colour.intrinsics));
    fuzz::require(is_rigid(contents.depth_from_colour, 1e-4F) && contents.depth_units_per_m > 0.0);
    constexpr int kMaxPixels = 1 << 16;  // larger images take long to clear
    const bool small = contents.depth_size.width * contents.depth_size.height <= kMaxPixels;
    constexpr std::size_t kMaxFrames = 4;
    for (std::size_t i = 0; i < std::min(kMaxFrames, contents.frames.size()); ++i) {
      const io::StoredImage& depth = contents.frames[i].depth;
      fuzz::require(depth.offset + depth.num_bytes <= size && contents.frames[i].colour.offset <= size);
      if (!small) continue;
      fuzz::attempt([&] { io::decode_raw_depth(bytes.substr(depth.offset, depth.num_bytes), depth, contents.depth_size); });
    }
  });
  return 0;
}

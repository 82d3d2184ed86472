// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// Features and leaf lookup: from a frame to the leaves its pixels reach. Reference: [Cavallari2017] Sec. 2.2.1, Eq. 1 and 2.
#pragma once

#include <cstdint>

#include "foothold/api/frame.h"
#include "foothold/base/array.h"
#include "foothold/base/context.h"
#include "foothold/relocalisation/forest.h"

namespace foothold {

/// One pixel of the image that features are evaluated on: everything a split can ask for, in 8 bytes.
struct FeaturePixel {
  /// Indexed by FeatureChannel: mean of the valid depths [mm], 0 for none; mean red, green and blue [grey levels].
  std::int16_t channels[4] = {};

  FOOTHOLD_HD int depth_mm() const { return channels[0]; }
  FOOTHOLD_HD int r() const { return channels[1]; }
  FOOTHOLD_HD int g() const { return channels[2]; }
  FOOTHOLD_HD int b() const { return channels[3]; }
};
static_assert(sizeof(FeaturePixel) == 8, "loaded as one word");

/// A frame averaged down and packed.
struct FeatureImageView {
  const FeaturePixel* pixels = nullptr;
  int width = 0;
  int height = 0;
  /// Pixels of this image per unit of a feature's offset, times millimetres: partner = p + offset * scale / depth_mm.
  float offset_scale_px_mm = 0.0F;
};

/// Owns the packed image of the current frame.
class FeatureImage {
 public:
  explicit FeatureImage(const Context& context) : pixels_(context.memory()) {}

  /// Averages blocks of downscale x downscale pixels of a frame in the context's memory.
  void compute(const Context& context, const Frame& frame, int downscale);
  FeatureImageView view() const { return view_; }
  int downscale() const { return downscale_; }

 private:
  Array<FeaturePixel> pixels_;
  FeatureImageView view_;
  int downscale_ = 1;
};

/// A pixel of the full frame with its camera point; depth 0 marks a place where none was found.
struct SampledPixel {
  std::int16_t u = 0;
  std::int16_t v = 0;
  float depth_m = 0.0F;
};
static_assert(sizeof(SampledPixel) == 8, "loaded as one word");

/// Finds the leaf that each sampled pixel reaches in each tree.
///
/// @param leaves  Output, num_trees x num_pixels, tree by tree: leaf numbers, or forest.num_leaves for pixels without depth.
void find_leaves(const Context& context, const FeatureImage& image, const ForestView& forest, Span<const SampledPixel> pixels,
                 Span<std::uint32_t> leaves);

}  // namespace foothold

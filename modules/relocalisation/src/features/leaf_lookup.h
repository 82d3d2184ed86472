// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// Leaf lookup: from a feature image to the leaves its pixels reach.
#pragma once

#include <cstdint>

#include "foothold/relocalisation/feature_image.h"

namespace foothold {

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

// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// The image that features are evaluated on, and their evaluation. Reference: [Cavallari2017] Sec. 2.2.1, Eq. 1 and 2.
#pragma once

#include <cmath>
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

  /// Mean depth [mm]; 0 for none.
  FOOTHOLD_HD int depth_mm() const { return channels[0]; }
  /// Mean red [grey levels].
  FOOTHOLD_HD int r() const { return channels[1]; }
  /// Mean green [grey levels].
  FOOTHOLD_HD int g() const { return channels[2]; }
  /// Mean blue [grey levels].
  FOOTHOLD_HD int b() const { return channels[3]; }
};
static_assert(sizeof(FeaturePixel) == 8, "loaded as one word");

/// A frame averaged down and packed.
struct FeatureImageView {
  const FeaturePixel* pixels = nullptr;  ///< the first pixel of the first row, in the context's memory
  int width = 0;                         ///< columns
  int height = 0;                        ///< rows
  /// Pixels of this image per unit of a feature's offset, times millimetres: partner = p + offset * scale / depth_mm.
  float offset_scale_px_mm = 0.0F;
};

/// The width [px] that sizes in settings refer to.
inline constexpr int kReferenceWidthPx = 640;

/// A size in pixels of a 640 px wide frame, on a frame of another width: at least 1.
constexpr int scaled_to_width(int size_px, int width) {
  const int scaled = (size_px * width + kReferenceWidthPx / 2) / kReferenceWidthPx;
  return scaled > 1 ? scaled : 1;
}

/// Owns the packed image of the current frame. Copies own their pixels.
class FeatureImage {
 public:
  /// An empty image in the context's memory.
  explicit FeatureImage(const Context& context) : pixels_(context.memory()) {}

  /// Averages blocks of downscale x downscale pixels of a frame in the context's memory.
  void compute(const Context& context, const Frame& frame, int downscale);
  /// The image of the same view in another light: colours times a gain, at most white. Not of itself.
  void relight(const Context& context, const FeatureImage& image, float gain);
  /// What kernels see of it, while it lives and is not computed again.
  FeatureImageView view() const { return {pixels_.data(), width_, height_, offset_scale_px_mm_}; }
  /// Pixels of the frame per pixel of the image, along a side.
  int downscale() const { return downscale_; }

 private:
  Array<FeaturePixel> pixels_;
  int width_ = 0;
  int height_ = 0;
  int downscale_ = 1;
  float offset_scale_px_mm_ = 0.0F;
};

/// The index nearest to i in [0, size).
FOOTHOLD_HD inline int clamp_index(int i, int size) { return i < 0 ? 0 : (i >= size ? size - 1 : i); }

/// The pixel of the image nearest to an offset [px] from pixel (u, v), clamped to the image: its index.
FOOTHOLD_HD FOOTHOLD_INLINE int partner_of(const FeatureImageView& image, int u, int v, float offset_u, float offset_v) {
  const int partner_u = clamp_index(u + static_cast<int>(std::floor(offset_u + 0.5F)), image.width);
  const int partner_v = clamp_index(v + static_cast<int>(std::floor(offset_v + 0.5F)), image.height);
  return partner_v * image.width + partner_u;
}

/// The difference of a channel between pixel (u, v) of the feature image and its partner, which is clamped to the image: [mm] for depth,
/// [grey levels] for colour. Reference: [Cavallari2017] Eq. 1 and 2.
///
/// @param px_per_offset  image.offset_scale_px_mm over the pixel's depth [mm].
FOOTHOLD_HD inline int evaluate_feature(const FeatureImageView& image, int u, int v, float px_per_offset, const ForestFeature& feature) {
  const int partner = partner_of(image, u, v, feature.offset_u_px_m * px_per_offset, feature.offset_v_px_m * px_per_offset);
  const auto channel = static_cast<int>(feature.channel);
  return image.pixels[v * image.width + u].channels[channel] - image.pixels[partner].channels[channel];
}

}  // namespace foothold

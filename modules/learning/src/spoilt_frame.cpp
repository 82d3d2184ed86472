// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "spoilt_frame.h"

namespace foothold {

namespace {
/// Part of the light that is left in the dark.
constexpr float kDarkness = 0.04F;
/// Depth noise of a burst, as a part of the depth; about ten times a Kinect's at 2 m.
constexpr float kBurstNoise = 0.05F;
/// Part of the readings that a burst swallows.
constexpr float kBurstLoss = 0.4F;

void darken(Image<Rgb8>& colour, float gain) {
  for (std::size_t i = 0; i < colour.size(); ++i) {
    Rgb8& pixel = colour.data()[i];
    for (std::uint8_t* channel : {&pixel.r, &pixel.g, &pixel.b}) *channel = static_cast<std::uint8_t>(gain * static_cast<float>(*channel));
  }
}

/// A slanted plane near the lens, partly too near to be measured.
void cover(Image<float>& depth, Random& random) {
  const float middle_m = random.uniform(0.15F, 0.6F);
  const float slope_u = random.uniform(-0.4F, 0.4F) * middle_m / static_cast<float>(depth.width());
  const float slope_v = random.uniform(-0.4F, 0.4F) * middle_m / static_cast<float>(depth.height());
  for (int v = 0; v < depth.height(); ++v) {
    for (int u = 0; u < depth.width(); ++u)
      depth(u, v) = middle_m + slope_u * static_cast<float>(u) + slope_v * static_cast<float>(v) + random.uniform(-0.005F, 0.005F);
  }
}
}  // namespace

void spoil(RgbdFrame& frame, Spoilage spoilage, Random& random) {
  switch (spoilage) {
    case Spoilage::kNone:
      break;
    case Spoilage::kDark:
      darken(frame.colour, kDarkness);
      break;
    case Spoilage::kCovered:
      darken(frame.colour, kDarkness);
      cover(frame.depth, random);
      break;
    case Spoilage::kNoise:
      for (std::size_t i = 0; i < frame.depth.size(); ++i) {
        float& depth_m = frame.depth.data()[i];
        depth_m *= random.uniform() < kBurstLoss ? 0.0F : 1.0F + random.uniform(-2.0F, 2.0F) * kBurstNoise;
      }
      break;
  }
}

}  // namespace foothold

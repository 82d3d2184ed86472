// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// What a frame teaches: pixels of a jittered grid with their scene points. Reference: [Cavallari2017] Sec. 2.2.2, step 1.
#pragma once

#include <cstdint>

#include "features/leaf_lookup.h"
#include "foothold/api/frame.h"
#include "foothold/base/array.h"
#include "foothold/base/context.h"
#include "foothold/relocalisation/settings.h"

namespace foothold {

/// A point in millimetres from the origin of the place that remembers it, with its colour in 5, 6 and 5 bits: 8 bytes.
struct ReservoirPoint {
  std::int16_t x_mm = 0;
  std::int16_t y_mm = 0;
  std::int16_t z_mm = 0;
  std::uint16_t rgb565 = 0;
};
static_assert(sizeof(ReservoirPoint) == 8, "loaded as one word");

/// Farthest coordinate of a place, from its origin along each axis [mm].
inline constexpr float kReachMm = 32767.0F;

/// Examples of one frame, in grid order.
struct TrainingExamples {
  explicit TrainingExamples(const Memory& memory) : pixels(memory), points(memory), surface_keys(memory), leaves(memory) {}
  Array<SampledPixel> pixels;
  Array<ReservoirPoint> points;
  Array<std::uint64_t> surface_keys;  ///< see surface_pieces.h; LearntViews::keep_new() uses them up
  Array<std::uint32_t> leaves;        ///< num_trees x num_pixels
};

/// Picks a pixel of each grid cell with its point and surface key, still without colour; depth 0 where there is none, or beyond kReachMm.
///
/// @param scene_from_camera  pose in the frame whose origin is the place's.
/// @param frame_seed         chooses the pixels when the settings ask for jitter.
void sample_examples(const Context& context, const Frame& frame, const ReservoirSettings& settings, const SE3& scene_from_camera,
                     std::uint64_t frame_seed, TrainingExamples& examples);

/// Gives the examples' points the colours of their pixels in the averaged image.
void colour_examples(const Context& context, const FeatureImage& image, TrainingExamples& examples);

}  // namespace foothold

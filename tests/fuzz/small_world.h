// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// A small camera before a small wall, and methods with settings to match: what fuzz targets use with what they have loaded, some hundred
/// times a second.
#pragma once

#include <cmath>
#include <string>
#include <vector>

#include "foothold/api/frame.h"
#include "foothold/api/relocaliser.h"
#include "foothold/base/context.h"
#include "fuzz.h"

namespace foothold::fuzz {

inline const Context& one_thread() {
  static const Context context([] {
    ContextOptions options;
    options.num_threads = 1;
    return options;
  }());
  return context;
}

/// A wavy, chequered wall half a metre ahead. The camera moves 1 cm a frame; the wall lies within one block of voxels of 10 cm.
inline RgbdFrame small_frame(int index) {
  constexpr int kWidth = 24;
  constexpr int kHeight = 18;
  RgbdFrame frame;
  frame.index = index;
  frame.timestamp_s = index / 30.0;
  frame.calibration.depth = frame.calibration.colour = {24.0F, 24.0F, 11.5F, 8.5F};
  frame.depth = Image<float>(kWidth, kHeight);
  frame.colour = Image<Rgb8>(kWidth, kHeight);
  const float shift_m = 0.01F * static_cast<float>(index);
  for (int v = 0; v < kHeight; ++v) {
    for (int u = 0; u < kWidth; ++u) {
      const float x = static_cast<float>(u) * 0.02F + shift_m;
      const float y = static_cast<float>(v) * 0.02F;
      frame.depth(u, v) = 0.5F + 0.03F * std::sin(20.0F * x) * std::cos(15.0F * y);
      const int cell = static_cast<int>(x / 0.05F) + 3 * static_cast<int>(y / 0.05F);
      frame.colour(u, v) = {static_cast<std::uint8_t>(cell * 37), static_cast<std::uint8_t>(cell * 91),
                            static_cast<std::uint8_t>(cell * 53)};
    }
  }
  frame.world_from_camera = SE3{};
  frame.world_from_camera->translation = {0.4F + shift_m, 0.4F, -0.1F};
  return frame;
}

/// Asks, learns and goes on: poses are poses, and confidences probabilities.
inline void use(Relocaliser& relocaliser) {
  static const RgbdFrame frame = small_frame(3);
  for (const PoseEstimate& estimate : relocaliser.relocalise(frame.view())) {
    require(is_rigid(estimate.world_from_camera) && estimate.confidence >= 0.0F && estimate.confidence <= 1.0F);
  }
  relocaliser.train(frame.view(), *frame.world_from_camera);
  relocaliser.update();
  require(relocaliser.state_bytes() < (1U << 30U));
}

}  // namespace foothold::fuzz

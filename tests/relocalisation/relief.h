// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// Depth images that differ from each other.
#pragma once

#include <cmath>

#include "foothold/base/image.h"
#include "foothold/base/random.h"

namespace foothold::test {

/// A smooth random relief between about 1 and 3 m.
inline Image<float> random_relief(Random& random, int width, int height) {
  Image<float> depth(width, height, 2.0F);
  for (int wave = 0; wave < 6; ++wave) {
    const float fx = random.uniform(-9.0F, 9.0F) / static_cast<float>(width);
    const float fy = random.uniform(-9.0F, 9.0F) / static_cast<float>(height);
    const float phase = random.uniform(0.0F, 6.28F);
    for (int v = 0; v < height; ++v) {
      for (int u = 0; u < width; ++u) depth(u, v) += 0.2F * std::sin(fx * static_cast<float>(u) + fy * static_cast<float>(v) + phase);
    }
  }
  return depth;
}

}  // namespace foothold::test

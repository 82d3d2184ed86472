// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#pragma once

#include "foothold/base/random.h"
#include "foothold/base/se3.h"

namespace foothold::test {

/// A random motion: each component of its rotation [rad] and translation [m], as se3_exp() takes them, is within +-scale.
inline SE3 random_motion(Random& random, float rotation_rad, float translation_m) {
  Tangent6 tangent;
  for (int i = 0; i < 3; ++i) tangent[i] = random.uniform(-rotation_rad, rotation_rad);
  for (int i = 3; i < 6; ++i) tangent[i] = random.uniform(-translation_m, translation_m);
  return se3_exp(tangent);
}

}  // namespace foothold::test

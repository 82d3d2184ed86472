// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// Frames as they come from a camera in trouble.
#pragma once

#include "foothold/api/frame.h"
#include "foothold/base/random.h"

namespace foothold {

enum class Spoilage {
  kNone,
  kDark,     ///< depth as it was, hardly any light
  kCovered,  ///< something right before the lens
  kNoise     ///< a burst of noise in depth
};

/// Spoils a frame's images.
void spoil(RgbdFrame& frame, Spoilage spoilage, Random& random);

}  // namespace foothold

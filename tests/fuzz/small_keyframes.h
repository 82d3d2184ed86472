// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// A relocaliser of few ferns.
#pragma once

#include "foothold/relocalisation/keyframe_relocaliser.h"
#include "small_world.h"

namespace foothold::fuzz {

inline KeyframeRelocaliserSettings small_keyframe_settings() {
  KeyframeRelocaliserSettings settings;
  settings.num_ferns = 32;
  settings.min_threshold_m = 0.4F;
  settings.max_threshold_m = 0.6F;
  settings.max_keyframes = 64;
  return settings;
}

}  // namespace foothold::fuzz

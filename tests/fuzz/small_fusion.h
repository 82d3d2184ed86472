// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// Settings of fusion under which a map of the small wall takes a few kB.
#pragma once

#include "foothold/fusion/fusion_pipeline.h"
#include "small_world.h"

namespace foothold::fuzz {

inline FusionSettings small_fusion_settings() {
  FusionSettings settings;
  settings.volume.voxel_size_m = 0.1F;
  settings.volume.truncation_m = 0.2F;
  settings.volume.max_blocks = 256;
  settings.render_divisor = 1;
  return settings;
}

}  // namespace foothold::fuzz

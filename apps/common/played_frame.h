// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#pragma once

#include "foothold/evaluation/kidnap.h"
#include "foothold/fusion/fusion_pipeline.h"

namespace foothold::apps {

/// What the judge of kidnaps needs to know of a frame. A pose is believed when the gate calls it good.
inline PlayedFrame played(const FusionFrameResult& result) {
  const bool believed = result.world_from_camera.has_value() && result.quality == TrackingQuality::kGood;
  return {result.world_from_camera, believed, result.fused, result.total_ms};
}

}  // namespace foothold::apps

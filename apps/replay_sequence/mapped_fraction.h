// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#pragma once

#include "foothold/fusion/fusion_pipeline.h"

namespace foothold::replay {

/// Which part of a frame's depth lies on mapped surface when seen from a pose, in [0, 1].
/// @param context  The pipeline's. @param frame_host  In host memory.
double mapped_fraction(const Context& context, const FusionPipeline& pipeline, const Frame& frame_host, const SE3& world_from_camera);

}  // namespace foothold::replay

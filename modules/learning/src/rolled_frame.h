// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// What a camera turned about its optical axis would have seen.
#pragma once

#include "foothold/api/frame.h"

namespace foothold {

/// Turns a frame about the optical axis of its depth camera, which changes no depth. Parts that the frame did not see have no depth and are
/// black.
///
/// @param angle_rad  The new camera's roll, clockwise as seen from behind the camera. Colour must be registered to depth, or nearly so.
/// @return A frame with the pose of the turned camera, if the old one had a pose. The same intrinsics; nearest pixels, so that depth edges
/// stay sharp.
RgbdFrame rolled_frame(const RgbdFrame& frame, float angle_rad);

}  // namespace foothold

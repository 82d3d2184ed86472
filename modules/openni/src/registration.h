// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// Depth-to-colour registration for cameras that do not offer it.
#pragma once

#include "foothold/api/frame.h"

namespace foothold::capture {

/// Renders a depth image as the colour camera would have measured it.
///
/// Every depth pixel is moved as the small square that it covers, so that no gaps open between neighbours; where squares overlap, the
/// nearest wins. Depth becomes z in the colour camera's frame.
///
/// @param depth        z in metres in the depth camera; 0, negative and NaN mean no measurement.
/// @param calibration  Intrinsics of both cameras for images of this size, and depth_from_colour.
/// @param registered   Receives the image, of the same size; 0 where nothing was measured.
/// Cost: one pass over the image, a few milliseconds for 640x480.
void register_depth_to_colour(const Image<float>& depth, const RgbdCalibration& calibration, Image<float>& registered);

}  // namespace foothold::capture

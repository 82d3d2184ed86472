// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// Registration of colour to depth, for cameras and recordings that leave it to others.
#pragma once

#include "foothold/api/frame.h"

namespace foothold {

/// True if depth and colour share one camera: a pixel of the one shows what the same pixel of the other does.
bool is_registered(const RgbdCalibration& calibration);

/// Warps a frame's colour into its depth camera's view, and says so in its calibration; does nothing where they share one already.
///
/// Each depth pixel takes the bilinear colour of the surface point it sees; pixels without depth assume the frame's median depth (or
/// nearly); points outside the colour image take its border, points behind the colour camera black. What the colour camera cannot see
/// behind a foreground takes the foreground's colour.
///
/// @pre Depth and colour have the same size.
/// Cost: about 1.4 ms for 640x480 pixels on one core; eight bytes a pixel as scratch.
void register_colour(RgbdFrame& frame);

}  // namespace foothold

// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// Registration of colour to depth.
#pragma once

#include "foothold/api/frame.h"

namespace foothold::io {

/// Warps a frame's colour into its depth camera's view, and says so in its calibration. Each depth pixel takes the bilinear colour of the
/// surface point it sees; pixels without depth assume the frame's median depth (or nearly); points outside the colour image take its
/// border. What the colour camera cannot see behind a foreground takes the foreground's colour.
void register_colour(RgbdFrame& frame);

}  // namespace foothold::io

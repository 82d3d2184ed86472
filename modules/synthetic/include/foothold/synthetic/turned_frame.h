// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// Frames as a camera held otherwise, or a mirror, would show them; no pixel is made up or lost.
#pragma once

#include "foothold/api/frame.h"

namespace foothold {

/// The frame of a camera turned about its optical axis, so that the image turns clockwise by quarters.
RgbdFrame turned_frame(const RgbdFrame& frame, int num_quarters);

/// The frame with left and right exchanged: a view of a place that does not exist. The pose is that of the mirrored world.
RgbdFrame mirrored_frame(const RgbdFrame& frame);

}  // namespace foothold

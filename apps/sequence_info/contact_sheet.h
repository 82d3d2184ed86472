// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// A recording at a glance.
#pragma once

#include "foothold/base/image.h"
#include "foothold/io/recording.h"

namespace foothold::info {

/// Twelve frames spread over a recording, registered colour above depth (0.5 to 5 m, near bright and far dark), and the camera's path from
/// above: what does not fit together shows at once. Frames that cannot be read stay empty, with the reason.
Image<Rgb8> contact_sheet(const Recording& recording);

}  // namespace foothold::info

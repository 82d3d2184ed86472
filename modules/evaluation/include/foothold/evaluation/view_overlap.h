// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// How much of a view others have seen.
#pragma once

#include <memory>
#include <vector>

#include "foothold/api/frame.h"

namespace foothold {

/// The share of a view's surface that lies in at least one other view, at the depth measured there: about one in 200 pixels is asked.
/// Surfaces count as the same up to 10 cm apart.
///
/// @return In [0, 1]; 0 for a view without depth.
/// @pre All frames have their true pose.
double share_seen(const RgbdFrame& view, const std::vector<std::shared_ptr<const RgbdFrame>>& others);

}  // namespace foothold

// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// The plane that a trajectory is drawn on.
#pragma once

#include <vector>

#include "common/canvas.h"
#include "foothold/evaluation/protocol.h"

namespace foothold::benchmark {

/// Positions of the tested cameras [m] seen from above: x along the longer side of the trajectory, y across it.
///
/// "Above" is where the cameras' upper edges point on average, since recordings do not say which way is up.
std::vector<cv::Point2d> seen_from_above(const std::vector<TestRecord>& tests);

}  // namespace foothold::benchmark

// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// Times in other units than seconds.
#pragma once

#include <vector>

namespace foothold::io {

/// What a unit of the times of consecutive frames is worth [s], told by their median spacing: no recording has fewer than one frame in
/// eight seconds, or more than 125 a second. @return 1, 1e-3, 1e-6 or 1e-9; 1 for fewer than two times.
double seconds_per_unit(std::vector<double> times);

/// The unit in which other times overlap those of frames [s]: the largest of 1, 1e-3, 1e-6 and 1e-9 that does; 1 if none does.
double overlapping_unit(double first, double last, double first_frame_s, double last_frame_s);

/// Such as "milliseconds".
const char* time_unit_name(double seconds_per_unit);

}  // namespace foothold::io

// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// Times in other units than seconds.
#pragma once

#include <vector>

namespace foothold::io {

/// What a unit of the times of consecutive frames is worth [s], told by their median spacing: no recording has fewer than one frame in
/// eight seconds, or more than 125 a second. @return 1, 1e-3, 1e-6 or 1e-9; 1 for fewer than two times.
double seconds_per_unit(const std::vector<double>& times);

/// The unit in which samples, by rising time, tell of the time of the frames [s]: the largest of 1, 1e-3, 1e-6 and 1e-9 in which they cover
/// a good part of it, most of them at most `max_gap_s` apart; else the largest in which they cover a part; 1 if there is none.
/// @pre There is a sample.
double sample_unit(const std::vector<double>& times, double first_frame_s, double last_frame_s, double max_gap_s);

/// Such as "milliseconds".
const char* time_unit_name(double seconds_per_unit);

}  // namespace foothold::io

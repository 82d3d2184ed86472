// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// Numbers as text with a point, whatever the host's locale: std::setlocale() and std::locale::global() change printf and streams, not
/// these.
#pragma once

#include <string>

#include "foothold/base/platform.h"

namespace foothold {

/// As printf's %.{num_digits}g in the C locale: nine digits bring every float back, seventeen every double. @pre 0 < num_digits <= 17
std::string general_text(double value, int num_digits);

/// As printf's %.{num_decimals}f in the C locale. @pre 0 <= num_decimals <= 17
std::string fixed_text(double value, int num_decimals);

}  // namespace foothold

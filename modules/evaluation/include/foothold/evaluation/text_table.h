// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// Tables that read well in a terminal and are valid Markdown.
#pragma once

#include <string>
#include <vector>

namespace foothold {

/// A Markdown table whose columns are padded to a common width: the first aligned left, the others right.
/// @pre Every row has as many cells as the header.
std::string format_table(const std::vector<std::string>& header, const std::vector<std::vector<std::string>>& rows);

/// A number with a fixed number of decimals, or "-" if it is NaN or infinite.
std::string format_number(double value, int num_decimals);

}  // namespace foothold

// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// What a run was warned of, as the view shows it.
#pragma once

#include <string>
#include <vector>

#include "common/canvas.h"

namespace foothold::apps {

/// A message in which each long path has shrunk to "..." and its last parts.
std::string with_short_paths(const std::string& message);

/// A message in lines that fit a width, broken between words, or within those that are too long themselves.
std::vector<std::string> wrapped(const std::string& message, double height, double max_width);

/// Warnings, the last one first, as many as fit; says how many more there are.
void draw_warnings(Canvas& canvas, const cv::Rect& area, const std::vector<std::string>& warnings);

}  // namespace foothold::apps

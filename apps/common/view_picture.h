// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// The picture of a running reconstruction.
#pragma once

#include <opencv2/core.hpp>

#include "common/view_contents.h"

namespace foothold::apps {

inline constexpr int kViewWidth = 1280;
inline constexpr int kViewHeight = 720;

/// Draws the whole view: what the camera sees, what the map says it should see, how things stand, what they cost, and where the camera is.
///
/// @return kViewWidth x kViewHeight pixels of 8-bit BGR.
cv::Mat compose_view(const ViewContents& contents);

}  // namespace foothold::apps

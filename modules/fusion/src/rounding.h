// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// From places to indices.
#pragma once

#include <Eigen/Core>

#include "foothold/base/platform.h"

namespace foothold {

/// std::floor for values in the range of int, in a form that every compiler turns into few instructions.
FOOTHOLD_HD inline int floor_to_int(float x) {
  const int truncated = static_cast<int>(x);
  return truncated - static_cast<int>(static_cast<float>(truncated) > x);
}

/// The pixel of an image nearest to a place, or false outside: also for places that no int can name, and for NaN.
FOOTHOLD_HD inline bool nearest_pixel(const Eigen::Vector2f& place, int width, int height, int& u, int& v) {
  const float right = place.x() + 0.5F;
  const float down = place.y() + 0.5F;
  if (!(right >= 0.0F && down >= 0.0F && right < static_cast<float>(width) && down < static_cast<float>(height))) return false;
  u = static_cast<int>(right);
  v = static_cast<int>(down);
  return true;
}

}  // namespace foothold

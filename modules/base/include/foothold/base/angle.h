// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// Degrees, in which people state angles, and radians, in which everything is computed.
#pragma once

namespace foothold {

/// Degrees in a radian.
inline constexpr double kDegPerRad = 57.29577951308232;
/// Radians in a degree.
inline constexpr float kRadPerDeg = 0.017453293F;

}  // namespace foothold

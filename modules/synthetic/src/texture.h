// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// Procedural textures.
#pragma once

#include <Eigen/Core>
#include <cstdint>

#include "foothold/synthetic/room.h"

namespace foothold::synthetic_detail {

/// A place on a flat or unrolled face.
struct SurfacePoint {
  float u = 0.0F, v = 0.0F;            ///< from the middle of the face [m]
  float half_u = 1.0F, half_v = 1.0F;  ///< half size of the face [m]
  std::uint32_t seed = 0;
  float footprint_m = 0.0F;  ///< size of a pixel on the surface; finer detail is averaged
};

/// The share of light that the surface reflects, per channel in about [0, 1].
Eigen::Vector3f texture_colour(const Material& material, const SurfacePoint& point);

}  // namespace foothold::synthetic_detail

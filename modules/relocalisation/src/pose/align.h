// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// Surfaces of the frame, and the progress of aligning a pose with what the scene remembers of them.
#pragma once

#include <cstdint>

#include "foothold/base/array.h"
#include "foothold/base/se3.h"

namespace foothold {

/// A pooled pixel's surface: its averaged camera point and normal; no normal (zero) where the surface is broken or unmeasured.
struct SurfaceSample {
  float point_camera[3];   ///< [m]
  float normal_camera[3];  ///< unit length, towards the camera
};

/// Points that one leaf remembers around a sample (T): those that a pose which moves by millimetres may come to lie on, side by side.
inline constexpr int kNearPoints = 16;
struct NearPoints {
  std::int16_t x_mm[kNearPoints];
  std::int16_t y_mm[kNearPoints];
  std::int16_t z_mm[kNearPoints];
  std::int16_t num;
};
static_assert(sizeof(NearPoints) == 98, "lives in device memory");

/// A sample's distance along its normal to the points that are remembered around it, as weighted sums.
struct SurfaceOffset {
  float weight;
  float offset_mm;  ///< times the weight
};

/// The progress of an alignment; in device memory, so that no step waits for the host.
struct AlignmentState {
  SE3 scene_from_camera;
  std::int32_t ended;
};
static_assert(sizeof(AlignmentState) == 52, "lives in device memory");

/// Owns all of it.
struct Alignment {
  Alignment(const Memory& memory, int num_samples)
      : surfaces(memory, static_cast<std::size_t>(num_samples)), near(memory), offsets(memory, surfaces.size()), state(memory, 1) {}

  Array<SurfaceSample> surfaces;
  Array<NearPoints> near;        ///< samples x trees
  Array<SurfaceOffset> offsets;  ///< per sample
  Array<AlignmentState> state;
};

}  // namespace foothold

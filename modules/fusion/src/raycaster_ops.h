// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// The steps of Raycaster that run on a device.
#pragma once

#include "dispatch.h"
#include "foothold/fusion/raycaster.h"
#include "tsdf_view.h"

namespace foothold {

struct Raycaster::Scratch {
  explicit Scratch(MemoryKind memory) : pose(memory), cameras_from_world(memory), range_near(memory), range_far(memory), depths_m(memory) {}

  Array<SE3> pose;  ///< of a single rendering
  Array<SE3> cameras_from_world;
  Array<std::int32_t> range_near;  ///< depth [m] as the bits of a positive float, whose order is that of integers
  Array<std::int32_t> range_far;
  Array<float> depths_m;
};

template <Device kDevice>
struct RaycasterOps {
  using Scratch = Raycaster::Scratch;

  /// Renders from each pose into `map`, whose arrays have their sizes.
  static void render(const Context& context, const TsdfView& volume, const Array<SE3>& world_from_cameras, Scratch& scratch,
                     SurfaceMap& map);
};

}  // namespace foothold

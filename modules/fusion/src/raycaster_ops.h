// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// The steps of Raycaster that run on a device.
#pragma once

#include "dispatch.h"
#include "foothold/fusion/raycaster.h"
#include "tsdf_view.h"

namespace foothold {

struct Raycaster::Scratch {
  explicit Scratch(MemoryKind memory) : range_near(memory), range_far(memory), depths_m(memory) {}

  Array<std::int32_t> range_near;  ///< depth [m] as the bits of a positive float, whose order is that of integers
  Array<std::int32_t> range_far;
  Array<float> depths_m;
};

template <Device kDevice>
struct RaycasterOps {
  using Scratch = Raycaster::Scratch;

  static void render(const Context& context, const TsdfView& volume, const RaycasterSettings& settings, Scratch& scratch, SurfaceMap& map);
};

}  // namespace foothold

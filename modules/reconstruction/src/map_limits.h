// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// Tells when a map is too small for what the camera sees.
#pragma once

#include "foothold/base/context.h"
#include "foothold/fusion/fusion_pipeline.h"

namespace foothold {

/// Watches frame by frame how much a map leaves out, and warns once of each reason.
class MapLimits {
 public:
  /// Fills in FusionFrameResult::out_of_range_fraction. @param frame  as its host has it: depth in CUDA memory is not looked at.
  void watch(const Frame& frame, const TsdfSettings& volume, const Context& context, FusionFrameResult& result);
  /// Warns of a camera that may see beyond the map's coordinates.
  void watch_reach(const SE3& world_from_camera, const TsdfSettings& volume, const Context& context);

 private:
  void watch_range(const Frame& frame, const TsdfSettings& volume, const Context& context, FusionFrameResult& result);

  double num_measured_ = 0.0;  // pixels looked at so far
  double num_out_of_range_ = 0.0;
  bool told_reach_ = false;
  bool told_range_ = false;
  bool told_full_ = false;
};

}  // namespace foothold

// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// The steps of ViewCheck that run on a device.
#pragma once

#include <vector>

#include "dispatch.h"
#include "foothold/fusion/view_check.h"

namespace foothold {

/// One compared pixel: depth [m], and grey in [0, 1] or -1 where the colour camera did not see the point.
struct CheckPixel {
  float depth_m;
  float grey;
};

/// What is summed over the pixels of a tile. From kColours on: over agreeing pixels with colour on both sides.
enum CheckSum {
  kValid,
  kOverlap,
  kAgree,
  kFront,
  kBehind,
  kDifference,
  kColours,
  kLive,
  kModel,
  kLive2,
  kModel2,
  kLiveModel,
  kNumCheckSums
};

struct ViewCheck::Scratch {
  explicit Scratch(MemoryKind memory) : pixels(memory), tile_sums(memory) {}

  Intrinsics intrinsics;  ///< of the reduced image
  int width = 0;
  int height = 0;
  Array<CheckPixel> pixels;
  Array<float> tile_sums;
};

template <Device kDevice>
struct ViewCheckOps {
  using Scratch = ViewCheck::Scratch;

  static void sample_frame(const Context& context, const Frame& frame, const ViewCheckSettings& settings, Scratch& scratch);
  /// The sums of each tile of 8 x 8 compared pixels, kNumCheckSums of them.
  static std::vector<float> compare(const Context& context, const SurfaceMap& model, const SE3& model_from_camera,
                                    const ViewCheckSettings& settings, Scratch& scratch);
};

}  // namespace foothold

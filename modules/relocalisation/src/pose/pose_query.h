// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// What an estimate works on.
#pragma once

#include "clustering/leaf_modes.h"
#include "foothold/api/frame.h"
#include "foothold/relocalisation/feature_image.h"
#include "reservoirs/leaf_reservoirs.h"

namespace foothold {

/// A frame whose camera is to be found.
struct PoseQuery {
  const Frame& frame;
  const FeatureImage& image;
  bool is_unfamiliar = false;  ///< likely of nowhere: hypotheses that explain next to nothing are given up early

  /// The depth camera as if its images were averaged as the feature image is.
  Intrinsics averaged_intrinsics() const { return frame.calibration.depth.scaled(1.0F / static_cast<float>(image.downscale())); }
};

/// What is remembered of the place to find it in. Poses and points of an estimate are in the place's frame.
struct PlaceView {
  LeafReservoirsView reservoirs;
  LeafModesView leaf_modes;
  Span<const ReservoirPoint> latest;  ///< what the camera that was learnt last saw
};

}  // namespace foothold

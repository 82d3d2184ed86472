// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// Projects frames into one another to see whether their poses fit their depth.
#pragma once

#include <memory>
#include <vector>

#include "foothold/base/camera.h"
#include "foothold/base/image.h"
#include "recorded_pose.h"

namespace foothold::io {

/// Two frames that see some of the same, with their poses in Foothold's convention as the recording is read.
struct FramePair {
  std::shared_ptr<const Image<float>> depth_a;
  std::shared_ptr<const Image<float>> depth_b;
  RecordedPose world_from_a;
  RecordedPose world_from_b;
  int frame_a = 0;
  int frame_b = 0;
};

/// What else might be meant by poses or depth.
struct Reading {
  PoseConvention convention;  ///< on top of the one the recording is read in
  double depth_factor = 1.0;  ///< what depths would have to be multiplied by
};

/// How well a reading fits.
struct Agreement {
  double fraction = 0.0;  ///< of the points that should be seen in the other frame, those that are, at their depth
  double seen = 0.0;      ///< of all points, those that should be seen in the other frame
  double score = 0.0;     ///< of all points, those that agree, each counting the more the better its depth fits: tells near misses apart
};

/// Projects the first frame of each pair into the second.
Agreement pose_agreement(const std::vector<FramePair>& pairs, const Intrinsics& camera, const Reading& reading);

/// Conventions of poses that people's files turn out to have, likelier ones first.
const std::vector<Reading>& other_conventions();

}  // namespace foothold::io

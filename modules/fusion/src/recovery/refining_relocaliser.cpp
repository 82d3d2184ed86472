// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "foothold/fusion/refining_relocaliser.h"

#include "foothold/fusion/tracking_quality.h"

namespace foothold {

RefiningRelocaliser::RefiningRelocaliser(Relocaliser& inner, const TsdfVolume& volume, const PoseRefinerSettings& settings,
                                         Refinement refinement)
    : RelocaliserDecorator(inner),
      volume_(volume),
      refiner_(volume.context(), settings, volume.settings().depth_range()),
      refinement_(refinement) {}

std::vector<PoseEstimate> RefiningRelocaliser::relocalise(const Frame& frame) {
  std::vector<PoseEstimate> proposals = inner().relocalise(frame);
  last_refined_.clear();
  if (proposals.empty()) return {};
  if (refinement_ == Refinement::kFirst) {
    last_refined_ = {refiner_.refine_one(frame, volume_, proposals.front().world_from_camera)};
    const RefinedPose& first = last_refined_.front();
    if (grade_tracking(first.measures).quality != TrackingQuality::kFailed) proposals.front().world_from_camera = first.world_from_camera;
    return proposals;
  }
  last_refined_ = refiner_.refine(frame, volume_, proposals);
  if (last_refined_.empty() || !last_refined_.front().accepted) return {};
  return {{last_refined_.front().world_from_camera, last_refined_.front().probability}};
}

float RefiningRelocaliser::acceptance_threshold() const {
  return refinement_ == Refinement::kFirst ? RelocaliserDecorator::acceptance_threshold() : refiner_.acceptance_probability();
}

}  // namespace foothold

// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "mapping_relocaliser.h"

#include <algorithm>

#include "foothold/base/error.h"
#include "foothold/fusion/tracking_quality.h"

namespace foothold::benchmark {

MappingRelocaliser::MappingRelocaliser(const Context& context, std::unique_ptr<Relocaliser> relocaliser, const TsdfSettings& map,
                                       const PoseRefinerSettings& refiner, Refinement refinement)
    : relocaliser_(std::move(relocaliser)), volume_(context, map), refiner_(context, refiner, map.depth_range()), refinement_(refinement) {
  if (context.memory() != MemoryKind::kHost) throw InvalidSettings("--device: got cuda, expected cpu for methods that refine on a map");
}

void MappingRelocaliser::train(const Frame& frame, const SE3& world_from_camera) {
  relocaliser_->train(frame, world_from_camera);
  volume_.integrate(frame, world_from_camera);
}

std::vector<PoseEstimate> MappingRelocaliser::relocalise(const Frame& frame) {
  std::vector<PoseEstimate> estimates = relocaliser_->relocalise(frame);
  if (estimates.empty()) return estimates;
  if (refinement_ == Refinement::kFirst) {
    const RefinedPose refined = refiner_.refine_one(frame, volume_, estimates.front().world_from_camera);
    if (grade_tracking(refined.measures).quality != TrackingQuality::kFailed) {
      estimates.front().world_from_camera = refined.world_from_camera;
    }
    return estimates;
  }
  std::vector<PoseEstimate> ranked;
  const float least_accepted = acceptance_threshold();
  for (const RefinedPose& refined : refiner_.refine(frame, volume_, estimates)) {
    ranked.push_back(
        {refined.world_from_camera, refined.accepted ? refined.probability : std::min(refined.probability, 0.99F * least_accepted)});
  }
  return ranked;
}

void MappingRelocaliser::reset() {
  relocaliser_->reset();
  volume_.reset();
}

float MappingRelocaliser::acceptance_threshold() const {
  return refinement_ == Refinement::kFirst ? relocaliser_->acceptance_threshold() : refiner_.acceptance_probability();
}

}  // namespace foothold::benchmark

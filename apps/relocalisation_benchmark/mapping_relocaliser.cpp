// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "mapping_relocaliser.h"

#include <algorithm>
#include <utility>

#include "foothold/base/error.h"

namespace foothold::benchmark {

MappingRelocaliser::MappingRelocaliser(const Context& context, std::unique_ptr<Relocaliser> relocaliser, const TsdfSettings& map,
                                       const PoseRefinerSettings& refiner, Refinement refinement)
    : RelocaliserDecorator(std::move(relocaliser)),
      volume_(context, map),
      refinement_(refinement),
      refining_(inner(), volume_, refiner, refinement) {
  if (context.memory() != MemoryKind::kHost) throw InvalidSettings("--device: got cuda, expected cpu for methods that refine on a map");
}

void MappingRelocaliser::train(const Frame& frame, const SE3& world_from_camera) {
  RelocaliserDecorator::train(frame, world_from_camera);
  volume_.integrate(frame, world_from_camera);
}

std::vector<PoseEstimate> MappingRelocaliser::relocalise(const Frame& frame) {
  std::vector<PoseEstimate> estimates = refining_.relocalise(frame);
  if (refinement_ == Refinement::kFirst) return estimates;
  std::vector<PoseEstimate> ranked;
  const float least_accepted = acceptance_threshold();
  for (const RefinedPose& refined : refining_.last_refined()) {
    ranked.push_back(
        {refined.world_from_camera, refined.accepted ? refined.probability : std::min(refined.probability, 0.99F * least_accepted)});
  }
  return ranked;
}

void MappingRelocaliser::reset() {
  RelocaliserDecorator::reset();
  volume_.reset();
}

}  // namespace foothold::benchmark

// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// A relocaliser that also builds a map from what it learns, and refines its answers on it.
#pragma once

#include <memory>
#include <vector>

#include "foothold/fusion/refining_relocaliser.h"

namespace foothold::benchmark {

/// Fuses the frames that it learns with their poses. On the host.
class MappingRelocaliser : public RelocaliserDecorator {
 public:
  MappingRelocaliser(const Context& context, std::unique_ptr<Relocaliser> relocaliser, const TsdfSettings& map,
                     const PoseRefinerSettings& refiner, Refinement refinement);

  void train(const Frame& frame, const SE3& world_from_camera) override;
  /// With kRanked: the candidates by falling score. What was not accepted stays below the threshold, whatever its probability.
  std::vector<PoseEstimate> relocalise(const Frame& frame) override;
  void reset() override;
  float acceptance_threshold() const override { return refining_.acceptance_threshold(); }

 private:
  TsdfVolume volume_;  // the reconstruction's, so that its memory is not counted
  Refinement refinement_;
  RefiningRelocaliser refining_;
};

}  // namespace foothold::benchmark

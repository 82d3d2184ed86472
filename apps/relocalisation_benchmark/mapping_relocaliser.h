// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// A relocaliser that also builds a map from what it learns, and refines its answers on it.
#pragma once

#include <memory>
#include <vector>

#include "foothold/api/relocaliser.h"
#include "foothold/fusion/pose_refiner.h"

namespace foothold::benchmark {

/// What is refined.
enum class Refinement {
  kFirst,  ///< the wrapped relocaliser's first estimate, as the paper's "+ ICP"; its confidence stays
  kRanked  ///< all of them; the order and the confidence are the acceptance classifier's
};

/// Fuses the frames that it learns with their poses. On the host.
class MappingRelocaliser : public Relocaliser {
 public:
  MappingRelocaliser(const Context& context, std::unique_ptr<Relocaliser> relocaliser, const TsdfSettings& map,
                     const PoseRefinerSettings& refiner, Refinement refinement);

  void train(const Frame& frame, const SE3& world_from_camera) override;
  /// With kRanked: the candidates by falling score. What was not accepted stays below the threshold, whatever its probability.
  std::vector<PoseEstimate> relocalise(const Frame& frame) override;
  void update() override { relocaliser_->update(); }
  void reset() override;
  /// The map is the reconstruction's and not counted.
  std::size_t state_bytes() const override { return relocaliser_->state_bytes(); }
  float acceptance_threshold() const override;

 private:
  std::unique_ptr<Relocaliser> relocaliser_;
  TsdfVolume volume_;
  PoseRefiner refiner_;
  Refinement refinement_;
};

}  // namespace foothold::benchmark

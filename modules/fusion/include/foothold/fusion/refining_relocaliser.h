// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// A relocaliser whose proposals are refined on the map.
#pragma once

#include "foothold/api/relocaliser_decorator.h"
#include "foothold/fusion/pose_refiner.h"

namespace foothold {

/// Which proposals are refined, and whose confidence counts.
enum class Refinement {
  kFirst,  ///< the paper's "+ ICP": the first is aligned with the map, and stays as it was where alignment fails; confidences stay
  kRanked  ///< all are aligned and ranked by rendering, and only one that the map agrees with is given, with its calibrated probability
};

/// Wraps another relocaliser: the paper's "+ ICP", or ranking by rendering with a calibrated acceptance.
///
/// Training, upkeep and memory are the wrapped relocaliser's. The map is only read.
/// Reference: [Cavallari2017] Sec. 3 for refinement by ICP, [Cavallari2019] for ranking by rendered depth.
class RefiningRelocaliser final : public RelocaliserDecorator {
 public:
  /// @pre `inner` and `volume` outlive this object and share the context's memory. @throws InvalidSettings
  RefiningRelocaliser(Relocaliser& inner, const TsdfVolume& volume, const PoseRefinerSettings& settings = {},
                      Refinement refinement = Refinement::kRanked);

  /// @return With kRanked the accepted pose with its probability, or nothing; with kFirst the proposals, the first of them refined.
  std::vector<PoseEstimate> relocalise(const Frame& frame) override;
  /// With kRanked the probability at which poses are accepted, with kFirst the wrapped relocaliser's threshold.
  float acceptance_threshold() const override;

  /// What became of the last frame's proposals, accepted or not, best first.
  const std::vector<RefinedPose>& last_refined() const { return last_refined_; }

 private:
  const TsdfVolume& volume_;
  PoseRefiner refiner_;
  Refinement refinement_;
  std::vector<RefinedPose> last_refined_;
};

}  // namespace foothold

// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// A relocaliser whose proposals are refined on the map and believed only if the map agrees.
#pragma once

#include "foothold/fusion/pose_refiner.h"

namespace foothold {

/// Wraps another relocaliser: the paper's "+ ICP", with ranking by rendering and a calibrated acceptance.
///
/// Training, upkeep and memory are the wrapped relocaliser's. The map is only read.
/// Reference: [Cavallari2017] Sec. 3 for refinement by ICP, [Cavallari2019] for ranking by rendered depth.
class RefiningRelocaliser final : public Relocaliser {
 public:
  /// @pre `inner` and `volume` outlive this object and share the context's memory. @throws InvalidSettings
  RefiningRelocaliser(Relocaliser& inner, const TsdfVolume& volume, const PoseRefinerSettings& settings = {});

  void train(const Frame& frame, const SE3& world_from_camera) override { inner_.train(frame, world_from_camera); }
  /// @return The accepted pose with its probability, or nothing.
  std::vector<PoseEstimate> relocalise(const Frame& frame) override;
  void update() override { inner_.update(); }
  void reset() override { inner_.reset(); }
  std::size_t state_bytes() const override { return inner_.state_bytes(); }
  float acceptance_threshold() const override { return refiner_.acceptance_probability(); }

  /// What became of the last frame's proposals, accepted or not, best first.
  const std::vector<RefinedPose>& last_refined() const { return last_refined_; }

 private:
  Relocaliser& inner_;
  const TsdfVolume& volume_;
  PoseRefiner refiner_;
  std::vector<RefinedPose> last_refined_;
};

}  // namespace foothold

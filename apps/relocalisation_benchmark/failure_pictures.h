// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// Draws why a relocalisation failed, in the manner of the paper's supplementary material. Reference: [Cavallari2017] supplement.
#pragma once

#include <string>
#include <vector>

#include "foothold/api/frame.h"
#include "foothold/base/context.h"
#include "foothold/evaluation/pose_error.h"
#include "foothold/fusion/raycaster.h"
#include "foothold/fusion/tsdf_volume.h"
#include "foothold/relocalisation/explanation.h"

namespace foothold::benchmark {

/// A frame that was not found.
struct FailureCase {
  std::string sequence;
  RgbdFrame frame;  ///< with its true pose
  Explanation explanation;

  const SE3& truth() const { return *frame.world_from_camera; }
  PoseError error_of(const ExplainedCandidate& candidate) const { return pose_error(candidate.world_from_camera, truth()); }
};

/// The scene's map, to be looked at from anywhere. In host memory.
class SceneModel {
 public:
  SceneModel(const Context& context, const TsdfSettings& settings);
  void add(const RgbdFrame& frame) { volume_.integrate(frame.view(), *frame.world_from_camera); }
  /// What a camera sees of the map; `background` where there is nothing.
  Image<Rgb8> render(const RenderCamera& camera, Rgb8 background);

 private:
  TsdfVolume volume_;
  Raycaster raycaster_;
  SurfaceMap map_;
};

/// The live frame, the map from the true pose, and from each of the last 16 hypotheses, with the correspondences that support each and its
/// energy.
Image<Rgb8> draw_candidates(const FailureCase& failure, SceneModel& model);

/// The map from a distance, with the modes that the leaves of some pixels hold, and the true and the estimated camera.
Image<Rgb8> draw_modes(const FailureCase& failure, SceneModel& model);

}  // namespace foothold::benchmark

// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// What a relocalisation considered, for people who look into failures.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "foothold/base/image.h"
#include "foothold/base/se3.h"

namespace foothold {

/// A hypothesis that came far.
struct ExplainedCandidate {
  SE3 world_from_camera;    ///< the proposed pose
  float confidence = 0.0F;  ///< as PoseEstimate::confidence, in [0, 1]
  /// Truncated Mahalanobis distance per pixel; with pose.as_published, candidates are ordered by it, but for the best,
  /// which was refined afterwards. Reference: [Cavallari2017] Eq. 4.
  float mean_energy = 0.0F;
  float inlier_fraction = 0.0F;  ///< pixels with a mode within 5 cm of where the pose puts them, among those with depth
};

/// A cluster of world points that a leaf remembers.
struct ExplainedMode {
  Eigen::Vector3f mean_world = Eigen::Vector3f::Zero();        ///< [m]
  Eigen::Matrix3f covariance_world = Eigen::Matrix3f::Zero();  ///< [m^2]
  Rgb8 colour;                                                 ///< the mean of its points
  int num_points = 0;                                          ///< points in its cluster
};

/// A pixel that was asked, and what its leaves, one of each tree, said.
struct ExplainedPixel {
  Eigen::Vector3f point_camera = Eigen::Vector3f::Zero();  ///< [m]; projecting it gives the pixel
  Rgb8 colour;                                             ///< of the pixel
  std::size_t first_mode = 0;                              ///< of its modes, which stand together
  std::size_t num_modes = 0;                               ///< of all leaves together
};

/// Something that the confidence in the best candidate was made from.
struct ExplainedEvidence {
  const char* name;  ///< what was measured; lives as long as the program
  float value;       ///< the measurement
};

/// Everything there was to choose from.
struct Explanation {
  std::vector<ExplainedCandidate> candidates;  ///< best first, as ForestRelocaliser::relocalise() returns them
  std::vector<ExplainedEvidence> evidence;     ///< of the best, before other places were compared with its own; none if not aligned
  std::vector<ExplainedPixel> pixels;          ///< those with modes; any prefix covers the image evenly
  std::vector<ExplainedMode> modes;            ///< of all pixels
};

}  // namespace foothold

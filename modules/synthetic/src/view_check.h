// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// Whether a pose is one that a person would hold a camera at, and what it sees of what was seen before.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "foothold/base/se3.h"
#include "foothold/synthetic/room.h"

namespace foothold::synthetic_detail {

/// The surface points [camera, m] where a coarse grid of rays over the view of a Kinect ends, nearest first.
std::vector<Eigen::Vector3f> sample_view(const Room& room, const SE3& world_from_camera);

/// True if the camera is inside the room, clear of every surface, and sees most of its view at a depth that a depth camera measures.
/// @param points_camera  What sample_view() returned for this camera.
bool is_good_view(const Room& room, const SE3& world_from_camera, const std::vector<Eigen::Vector3f>& points_camera);

/// The share of a camera's points that lie in the field of view of at least one other camera, whatever stands between.
float share_in_view(const SE3& world_from_camera, const std::vector<Eigen::Vector3f>& points_camera,
                    const std::vector<SE3>& world_from_others);

}  // namespace foothold::synthetic_detail

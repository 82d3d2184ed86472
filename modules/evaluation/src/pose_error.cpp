// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "foothold/evaluation/pose_error.h"

#include "foothold/base/angle.h"

#include <cmath>

namespace foothold {
namespace {

/// Degrees in a radian.
/// Poses are single precision: an error of exactly a limit must not fail by its rounding.
constexpr double kRounding = 1e-6;

}  // namespace

PoseError pose_error(const SE3& world_from_camera, const SE3& world_from_camera_true) {
  return {translation_distance_m(world_from_camera, world_from_camera_true),
          rotation_distance_rad(world_from_camera, world_from_camera_true)};
}

bool PoseThreshold::contains(const PoseError& error) const {
  return error.translation_m <= translation_m + kRounding && error.rotation_rad * kDegPerRad <= rotation_deg + kRounding;
}

std::string PoseThreshold::key() const {
  return std::to_string(std::lround(translation_m * 100.0)) + "cm_" + std::to_string(std::lround(rotation_deg)) + "deg";
}

const std::vector<PoseThreshold>& recall_ladder() {
  static const std::vector<PoseThreshold> ladder = {{0.01, 1.0}, {0.02, 2.0}, kFoundThreshold, kWrongThreshold};
  return ladder;
}

}  // namespace foothold

// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "lost_identities.h"

#include <Eigen/Geometry>
#include <algorithm>

namespace foothold::io {
namespace {

constexpr double kLeastLeap_m = 0.5;
constexpr double kLeastLeap_rad = 0.35;  // 20 degrees
/// A leap is at least so much longer than the longest other step.
constexpr double kLeapPerStep = 2.0;
/// From fewer steps it is not known how the camera moves.
constexpr int kLeastSteps = 8;

struct Motion {
  double translation_m = 0.0;
  double rotation_rad = 0.0;
};

Motion between(const RecordedPose& a, const RecordedPose& b) {
  return {(a.translation_m - b.translation_m).norm(), Eigen::AngleAxisd(a.rotation.transpose() * b.rotation).angle()};
}

bool is_identity(const std::optional<RecordedPose>& pose) { return pose.has_value() && io::is_identity(*pose); }

/// The longest steps between consecutive poses of which neither is the identity; nothing if they are too few.
std::optional<Motion> longest_step(const std::vector<std::optional<RecordedPose>>& poses) {
  Motion longest;
  int num_steps = 0;
  for (std::size_t i = 1; i < poses.size(); ++i) {
    if (!poses[i - 1].has_value() || !poses[i].has_value() || is_identity(poses[i - 1]) || is_identity(poses[i])) continue;
    const Motion step = between(*poses[i - 1], *poses[i]);
    longest.translation_m = std::max(longest.translation_m, step.translation_m);
    longest.rotation_rad = std::max(longest.rotation_rad, step.rotation_rad);
    ++num_steps;
  }
  return num_steps >= kLeastSteps ? std::optional<Motion>(longest) : std::nullopt;
}

}  // namespace

std::vector<std::size_t> find_lost_identities(const std::vector<std::optional<RecordedPose>>& poses) {
  const std::optional<Motion> longest = longest_step(poses);
  if (!longest.has_value()) return {};
  const auto is_leap = [&](const std::optional<RecordedPose>& pose) {
    if (!pose.has_value()) return false;
    const Motion motion = between(*pose, RecordedPose{});
    return motion.translation_m > std::max(kLeastLeap_m, kLeapPerStep * longest->translation_m) ||
           motion.rotation_rad > std::max(kLeastLeap_rad, kLeapPerStep * longest->rotation_rad);
  };
  std::vector<std::size_t> lost;
  for (std::size_t begin = 0; begin < poses.size();) {
    std::size_t end = begin;
    while (end < poses.size() && is_identity(poses[end])) ++end;
    const bool leaps_there = end > begin && begin > 0 && is_leap(poses[begin - 1]);
    if (leaps_there && (end == poses.size() || is_leap(poses[end]))) {
      for (std::size_t i = begin; i < end; ++i) lost.push_back(i);
    }
    begin = std::max(end, begin + 1);
  }
  return lost;
}

}  // namespace foothold::io

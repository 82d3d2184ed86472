// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "near_miss.h"

#include <array>
#include <cmath>

#include "foothold/base/number_text.h"
#include "text_file.h"

namespace foothold::io {
namespace {

using Kind = NearMiss::Kind;
using Poses = std::vector<std::optional<RecordedPose>>;

constexpr std::array<double, 16> kFactors{0.5, 0.6, 0.67, 0.75, 0.8, 0.83, 0.87, 0.9, 1.1, 1.15, 1.2, 1.25, 1.33, 1.5, 1.67, 2.0};
constexpr std::array<int, 13> kDelays{2, 3, 4, 6, 8, 10, 12, 15, 20, 25, 30, 40, 60};
/// Fewer pairs say little.
constexpr std::size_t kLeastPairs = 3;
/// A change fits far better if its score exceeds that of what is read by this factor, and by this much. (T) A focal length that is a tenth
/// off reaches 1.4 and 0.15 in RedKitchen seq-01, one that is a fifth off 1.7 and 0.16 in fr3/teddy; nothing that is right exceeds 1.
constexpr double kLeastRatio = 1.25;
constexpr double kLeastGain = 0.1;
constexpr double kLeastFraction = 0.6;

Intrinsics with_focal_factor(Intrinsics camera, double factor) {
  camera.fx *= static_cast<float>(factor);
  camera.fy *= static_cast<float>(factor);
  return camera;
}

std::shared_ptr<const Image<float>> along_axis(const Image<float>& along_rays, const Intrinsics& camera) {
  auto depth = std::make_shared<Image<float>>(along_rays.width(), along_rays.height());
  for (int v = 0; v < depth->height(); ++v) {
    for (int u = 0; u < depth->width(); ++u) {
      (*depth)(u, v) = along_rays(u, v) / camera.back_project(static_cast<float>(u), static_cast<float>(v), 1.0F).norm();
    }
  }
  return depth;
}

std::vector<FramePair> along_axis(std::vector<FramePair> pairs, const Intrinsics& camera) {
  for (FramePair& pair : pairs) {
    pair.depth_a = along_axis(*pair.depth_a, camera);
    pair.depth_b = along_axis(*pair.depth_b, camera);
  }
  return pairs;
}

/// Compares the pairs that have poses so many frames later with what they are with these.
NearMiss with_delay(const std::vector<FramePair>& pairs, const Intrinsics& camera, const Poses& poses, int delay) {
  const auto pose_at = [&](int frame) {
    const bool exists = frame + delay >= 0 && frame + delay < static_cast<int>(poses.size());
    return exists ? poses[static_cast<std::size_t>(frame + delay)] : std::nullopt;
  };
  std::vector<FramePair> as_read;
  std::vector<FramePair> delayed;
  for (FramePair pair : pairs) {
    const auto a = pose_at(pair.frame_a);
    const auto b = pose_at(pair.frame_b);
    if (!a.has_value() || !b.has_value()) continue;
    as_read.push_back(pair);
    pair.world_from_a = *a;
    pair.world_from_b = *b;
    delayed.push_back(pair);
  }
  if (delayed.size() < kLeastPairs) return {Kind::kDelay, 0.0, {}, {}};
  return {Kind::kDelay, static_cast<double>(delay), pose_agreement(delayed, camera, {}), pose_agreement(as_read, camera, {})};
}

}  // namespace

std::optional<NearMiss> find_near_miss(const std::vector<FramePair>& pairs, const Intrinsics& camera, const Poses& poses) {
  if (pairs.size() < kLeastPairs) return std::nullopt;
  const Agreement as_read = pose_agreement(pairs, camera, {});
  NearMiss best;
  const auto consider = [&](const NearMiss& each) {
    if (each.agreement.score - each.as_read.score > best.agreement.score - best.as_read.score) best = each;
  };
  for (const double factor : kFactors) {
    consider({Kind::kFocalLength, factor, pose_agreement(pairs, with_focal_factor(camera, factor), {}), as_read});
    consider({Kind::kDepth, factor, pose_agreement(pairs, camera, {{}, factor}), as_read});
  }
  consider({Kind::kRays, 1.0, pose_agreement(along_axis(pairs, camera), camera, {}), as_read});
  for (const int delay : kDelays) {
    consider(with_delay(pairs, camera, poses, delay));
    consider(with_delay(pairs, camera, poses, -delay));
  }
  const bool by_far = best.agreement.score > best.as_read.score + kLeastGain && best.agreement.score > kLeastRatio * best.as_read.score &&
                      best.agreement.fraction >= kLeastFraction;
  return by_far ? std::optional(best) : std::nullopt;
}

std::string describe(const NearMiss& miss, const Intrinsics& camera) {
  const auto about = [](double value) { return "about " + general_text(value, 3); };
  const auto fx = static_cast<double>(camera.fx);
  switch (miss.kind) {
    case Kind::kFocalLength:
      return "with focal lengths of " + about(miss.amount * fx) + " instead of " + numbers_text(&fx, 1) + " pixels (--intrinsics)";
    case Kind::kDepth:
      return "with depth " + about(miss.amount) + " times as large (--depth-scale)";
    case Kind::kRays:
      return "if it counted along rays instead of the optical axis, which is not read";
    case Kind::kDelay:
      break;
  }
  return "with the poses from " + about(std::abs(miss.amount)) + " frames " + (miss.amount > 0.0 ? "later" : "earlier") +
         ": images and poses may have different clocks";
}

}  // namespace foothold::io

// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// Confronting the best pose with all points that were drawn of the scene, and with poses that explain the frame, too. Not in the paper.
#pragma once

#include <cmath>

#include "pose/rank_kernels.h"

namespace foothold {

/// Grey value of a colour, in [0, 255].
template <class Colour>
FOOTHOLD_HD inline float grey_level(const Colour& r, const Colour& g, const Colour& b) {
  return 0.299F * static_cast<float>(r) + 0.587F * static_cast<float>(g) + 0.114F * static_cast<float>(b);
}

/// Projects the points into the frame from the best pose, and counts. One team.
template <class Executor>
struct ConfrontPoints {
  FeatureImageView image;
  Intrinsics intrinsics;  ///< of the averaged image
  const RememberedPoint* points;
  int num_points;
  HypothesesView hypotheses;
  SceneAgreement* agreement;

  FOOTHOLD_HD void operator()(const typename Executor::Team& team, std::size_t) const {
    const SE3& pose = hypotheses.pose_at(0);
    const Eigen::Matrix3f camera_from_scene = pose.rotation.transpose();
    float sums[kNumSums] = {};
    for (int i = team.lane(); i < num_points; i += team.size()) {
      const RememberedPoint& point = points[i];
      if (point.valid == 0) continue;
      const Eigen::Vector3f point_scene(point.point_scene[0], point.point_scene[1], point.point_scene[2]);
      add_point(camera_from_scene * (point_scene - pose.translation), point, sums);
    }
    team.sum_all(sums);
    if (team.lane() != 0) return;
    const float scale = 1.0F / (sums[kInView] + kAgreementPrior);
    agreement->agreeing_fraction = sums[kAgreeing] * scale;
    agreement->contradicted_fraction = sums[kContradicted] * scale;
    agreement->colour_correlation = correlation(sums);
    agreement->valid = 1;
  }

 private:
  enum Sum { kInView, kContradicted, kAgreeing, kLive, kScene, kLive2, kScene2, kLiveScene, kNumSums };

  FOOTHOLD_HD FOOTHOLD_INLINE void add_point(const Eigen::Vector3f& point_camera, const RememberedPoint& point,
                                             float (&sums)[kNumSums]) const {
    const PointSighting sighting = sight(image, intrinsics, point_camera);
    if (sighting.state == PointState::kOutOfView) return;
    sums[kInView] += 1.0F;
    sums[kContradicted] += sighting.state == PointState::kContradicted ? 1.0F : 0.0F;
    if (sighting.state != PointState::kAgrees) return;
    const FeaturePixel& pixel = image.pixels[sighting.pixel];
    // About the middle of their range, which keeps the sums' digits.
    const float live = grey_level(pixel.r(), pixel.g(), pixel.b()) * (1.0F / 128.0F) - 1.0F;
    const float scene = grey_level(point.rgb[0], point.rgb[1], point.rgb[2]) * (1.0F / 128.0F) - 1.0F;
    sums[kAgreeing] += 1.0F;
    sums[kLive] += live;
    sums[kScene] += scene;
    sums[kLive2] += live * live;
    sums[kScene2] += scene * scene;
    sums[kLiveScene] += live * scene;
  }

  /// Shrunk towards 0 where there are few points.
  FOOTHOLD_HD static float correlation(const float (&sums)[kNumSums]) {
    const float n = sums[kAgreeing];
    if (n < 2.0F) return 0.0F;
    const float live_variance = sums[kLive2] - sums[kLive] * sums[kLive] / n;
    const float scene_variance = sums[kScene2] - sums[kScene] * sums[kScene] / n;
    const float covariance = sums[kLiveScene] - sums[kLive] * sums[kScene] / n;
    const float product = live_variance * scene_variance;
    return product > 0.0F ? covariance / std::sqrt(product) * (n / (n + kAgreementPrior)) : 0.0F;
  }
};

/// Projects points into the frame from where the best pose is not. A view of a plain wall explains such poses, too. One team per shift.
/// Nothing is asked of a pose that is hopeless itself: 1, as if all agreed elsewhere.
template <class Executor>
struct ConfrontShifted {
  FeatureImageView image;
  Intrinsics intrinsics;  ///< of the averaged image
  const RememberedPoint* points;
  int num_points;
  HypothesesView hypotheses;
  const SceneAgreement* agreement;  ///< of the best pose
  float* shifted;

  FOOTHOLD_HD void operator()(const typename Executor::Team& team, std::size_t shift) const {
    constexpr float kHopeless = 0.2F;
    const SE3& pose = hypotheses.pose_at(0);
    const Eigen::Matrix3f camera_from_scene = pose.rotation.transpose();
    if (agreement->agreeing_fraction - agreement->contradicted_fraction < kHopeless) {
      if (team.lane() == 0) shifted[shift] = 1.0F;
      return;
    }
    const float distance_m = shift % 2 == 0 ? kShiftM : -kShiftM;
    const Eigen::Vector3f camera_scene = pose.translation + distance_m * pose.rotation.col(static_cast<int>(shift / 2));
    float counts[3] = {};  // in view, agreeing, contradicted
    for (int i = team.lane(); i < num_points; i += team.size()) {
      const RememberedPoint& point = points[i];
      if (point.valid == 0) continue;
      const Eigen::Vector3f point_scene(point.point_scene[0], point.point_scene[1], point.point_scene[2]);
      const PointState state = sight(image, intrinsics, camera_from_scene * (point_scene - camera_scene)).state;
      counts[0] += state != PointState::kOutOfView ? 1.0F : 0.0F;
      counts[1] += state == PointState::kAgrees ? 1.0F : 0.0F;
      counts[2] += state == PointState::kContradicted ? 1.0F : 0.0F;
    }
    team.sum_all(counts);
    if (team.lane() == 0) shifted[shift] = (counts[1] - counts[2]) / (counts[0] + kAgreementPrior);
  }
};

/// Looks for the best of the shifted poses, and of the candidates that were found elsewhere. One team.
template <class Executor>
struct FindRivals {
  HypothesesView hypotheses;
  const SceneEvidence* evidence;  ///< per hypothesis
  std::size_t num_candidates;
  const float* shifted;
  SceneAgreement* agreement;

  FOOTHOLD_HD void operator()(const typename Executor::Team& team, std::size_t) const {
    constexpr float kElsewhereRad = 0.2F;
    float rival = -1.0F;
    for (auto slot = static_cast<std::size_t>(team.lane()) + 1; slot < num_candidates; slot += static_cast<std::size_t>(team.size())) {
      if (hypotheses.has_failed(slot) || is_same_pose(hypotheses.pose_at(slot), hypotheses.pose_at(0), kShiftM, kElsewhereRad)) continue;
      const SceneEvidence& found = evidence[hypotheses.at(slot)];
      const float score = found.alike_fraction() - found.contradicted_fraction();
      rival = score > rival ? score : rival;
    }
    rival = team.highest(rival);
    if (team.lane() != 0) return;
    agreement->rival_agreement = rival;
    agreement->shifted_agreement = shifted[0];
    for (int i = 1; i < kNumShifts; ++i)
      agreement->shifted_agreement = shifted[i] > agreement->shifted_agreement ? shifted[i] : agreement->shifted_agreement;
  }
};

/// Leaves what the scene says about the hypothesis in the first slot. @pre The points were drawn, and the candidates ranked by them.
template <class Executor>
void confront(const Executor& executor, const PoseQuery& query, std::size_t num_candidates, Hypotheses& hypotheses, Ranking& ranking) {
  const FeatureImageView image = query.image.view();
  executor.for_each_team(1, ConfrontPoints<Executor>{image, query.averaged_intrinsics(), ranking.points.data(), kRememberedPoints,
                                                     hypotheses.view(), ranking.agreement.data()});
  executor.for_each_team(kNumShifts, ConfrontShifted<Executor>{image, query.averaged_intrinsics(), ranking.points.data(), kRankingPoints,
                                                               hypotheses.view(), ranking.agreement.data(), ranking.shifted.data()});
  executor.for_each_team(1, FindRivals<Executor>{hypotheses.view(), ranking.evidence.data(), num_candidates, ranking.shifted.data(),
                                                 ranking.agreement.data()});
}

}  // namespace foothold

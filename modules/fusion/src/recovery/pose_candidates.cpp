// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "foothold/fusion/pose_candidates.h"

#include <algorithm>
#include <cmath>

namespace foothold {
namespace {

// (T) replay_sequence, rendered rooms.
constexpr float kSameM = 0.15F;  ///< odometry drifts, and refinement pulls
constexpr float kSameDeg = 8.0F;
constexpr float kMostOfOneView = 2.5F;  ///< log odds: views err together now and then
constexpr float kContradicted = -0.5F;  ///< log odds at most of a view in which something is missing
constexpr float kUnseen = -0.5F;        ///< log odds of a frame in which refinement did not come to a candidate
constexpr float kDropped = -4.0F;       ///< log odds
constexpr float kSure = 4.6F;           ///< log odds: 0.99
constexpr float kLead = 2.2F;           ///< log odds over the next
constexpr int kFewestViews = 3;

float log_odds_of(const RefinedPose& pose) {
  const float probability = std::clamp(pose.probability, 1e-4F, 1.0F - 1e-4F);
  const float most = pose.contradicted ? kContradicted : kMostOfOneView;
  return std::clamp(std::log(probability / (1.0F - probability)), -kMostOfOneView, most);
}

}  // namespace

void PoseCandidates::move(const SE3& previous_from_current) {
  for (Candidate& candidate : candidates_) candidate.world_from_camera = candidate.world_from_camera * previous_from_current;
}

std::vector<PoseEstimate> PoseCandidates::proposals() const {
  std::vector<PoseEstimate> proposals;
  for (const Candidate& candidate : candidates_) proposals.push_back({candidate.world_from_camera, 0.0F});
  return proposals;
}

PoseCandidates::Candidate* PoseCandidates::find(const SE3& world_from_camera) {
  for (Candidate& candidate : candidates_) {
    if (is_near(candidate.world_from_camera, world_from_camera, kSameM, kSameDeg)) return &candidate;
  }
  return nullptr;
}

void PoseCandidates::weigh(Span<const RefinedPose> refined) {
  for (Candidate& candidate : candidates_) candidate.is_weighed = false;
  for (const RefinedPose& pose : refined) {
    const float view = log_odds_of(pose);
    Candidate* const known = find(pose.world_from_camera);
    if (known == nullptr) {
      if (view <= -kMostOfOneView) continue;
      candidates_.push_back({pose.world_from_camera, pose.world_from_camera, 0.0F, view, 1, 0, true});
      continue;
    }
    if (known->is_weighed) continue;
    known->is_weighed = true;
    known->num_frames_unseen = 0;
    known->world_from_camera = pose.world_from_camera;
    if (is_near(known->counted_world_from_camera, pose.world_from_camera, kNewViewM, kNewViewDeg)) {
      known->last_view = std::min(known->last_view, view);
      continue;
    }
    known->log_odds += known->last_view;
    known->last_view = view;
    known->counted_world_from_camera = pose.world_from_camera;
    ++known->num_views;
  }
  for (Candidate& candidate : candidates_) {
    if (candidate.is_weighed) continue;
    candidate.log_odds += kUnseen;
    ++candidate.num_frames_unseen;
  }
  candidates_.erase(std::remove_if(candidates_.begin(), candidates_.end(),
                                   [&](const Candidate& candidate) {
                                     return candidate.total() < kDropped || candidate.num_frames_unseen > settings_.max_frames_unseen;
                                   }),
                    candidates_.end());
  std::stable_sort(candidates_.begin(), candidates_.end(), [](const Candidate& a, const Candidate& b) { return a.total() > b.total(); });
  if (candidates_.size() > static_cast<std::size_t>(settings_.max_candidates)) {
    candidates_.resize(static_cast<std::size_t>(settings_.max_candidates));
  }
}

bool PoseCandidates::is_likeliest(const SE3& world_from_camera) const {
  return candidates_.empty() || is_near(candidates_.front().world_from_camera, world_from_camera, kSameM, kSameDeg);
}

const SE3* PoseCandidates::standing_alone() const {
  if (candidates_.empty()) return nullptr;
  const Candidate& best = candidates_.front();
  if (!best.is_weighed || best.num_views < kFewestViews || best.total() < kSure) return nullptr;
  if (candidates_.size() > 1 && best.total() - candidates_[1].total() < kLead) return nullptr;
  return &best.world_from_camera;
}

}  // namespace foothold

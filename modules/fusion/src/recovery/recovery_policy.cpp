// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "foothold/fusion/recovery_policy.h"

#include "foothold/base/contract.h"

namespace foothold {

const char* to_string(RecoveryState state) {
  switch (state) {
    case RecoveryState::kTracking:
      return "tracking";
    case RecoveryState::kSettling:
      return "settling";
    case RecoveryState::kLost:
      return "lost";
  }
  return "?";
}

void RecoveryPolicy::reset() { *this = RecoveryPolicy(settings_); }

bool RecoveryPolicy::should_relocalise(TrackingQuality tracked) const {
  if (state_ == RecoveryState::kLost || tracked == TrackingQuality::kFailed) return true;
  return state_ == RecoveryState::kSettling && (num_settling_ + 1) % kConfirmInterval == 0;
}

RecoveryDecision RecoveryPolicy::settle(int num_frames, PoseSource pose) {
  state_ = RecoveryState::kSettling;
  settle_length_ = num_frames;
  good_frames_left_ = num_frames;
  if (pose == PoseSource::kRelocaliser) views_left_ = kConfirmingViews;
  num_settling_ = 0;
  return {state_, pose, false, false};
}

RecoveryDecision RecoveryPolicy::update(TrackingQuality tracked, RelocalisationOutcome outcome, bool is_new_view) {
  FOOTHOLD_EXPECTS(outcome != RelocalisationOutcome::kNotAsked || !should_relocalise(tracked));
  FOOTHOLD_EXPECTS(state_ != RecoveryState::kLost || tracked == TrackingQuality::kFailed);
  const bool accepted = outcome == RelocalisationOutcome::kElsewhere || outcome == RelocalisationOutcome::kConfirms;
  num_poor_ = tracked == TrackingQuality::kPoor ? num_poor_ + 1 : 0;

  if (tracked == TrackingQuality::kFailed) {
    if (accepted) return settle(settings_.settle_frames, PoseSource::kRelocaliser);
    state_ = RecoveryState::kLost;
    return {state_, PoseSource::kNone, false, false};
  }
  if (outcome == RelocalisationOutcome::kElsewhere) {
    num_poor_ = 0;
    return settle(settings_.settle_frames, PoseSource::kRelocaliser);
  }
  if (tracked == TrackingQuality::kPoor) {
    constexpr int kUnconfirmedShare = 5;
    if (num_poor_ > settings_.max_poor_frames / (is_unconfirmed() ? kUnconfirmedShare : 1)) {
      state_ = RecoveryState::kLost;
      num_poor_ = 0;
      return {state_, PoseSource::kNone, false, false};
    }
    if (state_ == RecoveryState::kTracking) return settle(kSettleFramesAfterPoor, PoseSource::kTracker);
    good_frames_left_ = settle_length_;  // the good frames must follow one another
    ++num_settling_;
    return {state_, PoseSource::kTracker, false, false};
  }
  if (state_ == RecoveryState::kSettling) {
    ++num_settling_;
    if (is_new_view && views_left_ > 0) --views_left_;
    if (good_frames_left_ > 0) {
      --good_frames_left_;
      return {state_, PoseSource::kTracker, false, false};
    }
    if (views_left_ > 0) return {state_, PoseSource::kTracker, false, false};
    state_ = RecoveryState::kTracking;
  }
  return {state_, PoseSource::kTracker, true, true};
}

}  // namespace foothold

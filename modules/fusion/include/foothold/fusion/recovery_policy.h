// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// Decides, frame by frame, what a reconstruction does with what its tracker and relocaliser say. No images, no poses: a state machine.
#pragma once

#include "foothold/base/settings.h"
#include "foothold/fusion/tracking_quality.h"

namespace foothold {

/// What is known of the camera's pose.
enum class RecoveryState {
  kTracking,  ///< the pose is known: good frames are fused and learnt from
  kSettling,  ///< the pose is believed, but not yet enough to change the map
  kLost       ///< the pose is unknown: the map does not change
};

/// The name of a state, for people.
const char* to_string(RecoveryState state);

/// What came of asking the relocaliser, refined by ICP on the map and graded by the gate.
enum class RelocalisationOutcome {
  kNotAsked,
  kNothing,   ///< no pose was accepted
  kConfirms,  ///< the accepted pose is the tracked one
  kElsewhere  ///< a pose was accepted, and it is not the tracked one
};

/// Which pose of a frame counts.
enum class PoseSource { kNone, kTracker, kRelocaliser };

/// What to do with a frame.
struct RecoveryDecision {
  RecoveryState state = RecoveryState::kLost;  ///< after the frame
  PoseSource pose = PoseSource::kNone;         ///< whose pose to go on with
  bool fuse = false;                           ///< into the map
  bool train = false;                          ///< the relocaliser
};

/// Views from new places, all good, that a recovery must be confirmed by before the map may change: what looks alike from one place hardly
/// does from three (T: replay_sequence, office).
inline constexpr int kConfirmingViews = 2;

/// Good frames in a row after a single poor one before the map may change again (T: replay_sequence, kitchen).
inline constexpr int kSettleFramesAfterPoor = 3;

/// While settling, the relocaliser is asked for a second opinion every so many frames (T: replay_sequence, kitchen).
inline constexpr int kConfirmInterval = 3;

/// How long a pose must be good or poor before the state changes.
struct RecoverySettings {
  /// Good frames in a row after a recovery before the map may change again.
  int settle_frames = 10;
  /// Frames in a row that may be tracked poorly before the camera counts as lost; of a recovered pose that is not confirmed yet, a fifth of
  /// them.
  int max_poor_frames = 30;

  /// Shows each field to the visitor, with its name, what it means and its range.
  template <class Visitor>
  static void fields(Visitor& v) {
    v(&RecoverySettings::settle_frames, "settle_frames", "Good frames after a recovery before the map may change (R).", Range{0, 1000});
    v(&RecoverySettings::max_poor_frames, "max_poor_frames",
      "Poor frames in a row before the camera counts as lost (T: replay_sequence, kitchen).", Range{1, 100000});
  }
  /// Throws InvalidSettings naming the field, its value and its range.
  void validate() const { validate_settings(*this); }
};

/// The policy: good frames are fused and learnt from, poor ones neither; a failed one is relocalised at once; after a recovery nothing is
/// fused until tracking has settled and views from new places have confirmed the pose, during which the relocaliser may object.
///
/// | state    | tracked | relocaliser        | then     | pose         | fuse, train |
/// |----------|---------|--------------------|----------|--------------|-------------|
/// | tracking | good    | -                  | tracking | tracker      | yes         |
/// | tracking | poor    | -                  | settling | tracker      | no          |
/// | settling | good    | not elsewhere      | settling, at last tracking | tracker | on becoming tracking |
/// | settling | good    | elsewhere          | settling, anew | relocaliser | no     |
/// | settling | poor    | not elsewhere      | settling, at last lost | tracker | no  |
/// | any      | failed  | elsewhere, confirms | settling | relocaliser | no          |
/// | any      | failed  | nothing            | lost     | none         | no          |
///
/// Reference: [Prisacariu2017] for the gate's use and the hold after a recovery.
class RecoveryPolicy {
 public:
  /// @throws InvalidSettings
  explicit RecoveryPolicy(const RecoverySettings& settings = {}) : settings_(settings) { settings.validate(); }

  /// The state after the last frame.
  RecoveryState state() const { return state_; }
  /// Whether the pose is a recovered one that too few views have confirmed yet.
  bool is_unconfirmed() const { return state_ == RecoveryState::kSettling && views_left_ > 0; }
  /// Whether there is a pose to track from. When not, report the frame as kFailed.
  bool should_track() const { return state_ != RecoveryState::kLost; }
  /// Whether the relocaliser should be asked about this frame, given how tracking went.
  bool should_relocalise(TrackingQuality tracked) const;
  /// Takes what is known of a frame and decides.
  /// @param is_new_view  Whether the frame confirms a recovered pose: the map explains it, and it was taken from a new place.
  /// @pre The relocaliser was asked if should_relocalise() said so.
  RecoveryDecision update(TrackingQuality tracked, RelocalisationOutcome outcome, bool is_new_view = true);
  /// Back to the start: tracking.
  void reset();

 private:
  RecoveryDecision settle(int num_frames, PoseSource pose);

  RecoverySettings settings_;
  RecoveryState state_ = RecoveryState::kTracking;
  int settle_length_ = 0;     // good frames in a row that settling takes
  int good_frames_left_ = 0;  // while settling
  int views_left_ = 0;        // likewise, views that confirm
  int num_settling_ = 0;      // frames since settling began
  int num_poor_ = 0;          // in a row
};

}  // namespace foothold

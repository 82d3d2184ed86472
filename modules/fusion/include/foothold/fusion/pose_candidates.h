// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// Where a lost camera may be: poses that move with it, and gain and lose weight by what it sees. No images: bookkeeping alone.
#pragma once

#include <vector>

#include "foothold/api/relocaliser.h"
#include "foothold/base/settings.h"
#include "foothold/fusion/pose_refiner.h"

namespace foothold {

/// Motion of the camera that makes a view a new one [m]: evidence of its own (T: replay_sequence, office).
inline constexpr float kNewViewM = 0.10F;
/// The same for rotation [deg].
inline constexpr float kNewViewDeg = 8.0F;

/// How many poses a lost camera carries along, and how long.
struct PoseCandidatesSettings {
  /// How many poses are carried along.
  int max_candidates = 5;
  /// Frames after which a pose that was not seen again is dropped.
  int max_frames_unseen = 15;

  /// Shows each field to the visitor, with its name, what it means and its range.
  template <class Visitor>
  static void fields(Visitor& v) {
    v(&PoseCandidatesSettings::max_candidates, "max_candidates", "Poses that a lost camera carries along (T: replay_sequence, rooms).",
      Range{1, 100});
    v(&PoseCandidatesSettings::max_frames_unseen, "max_frames_unseen",
      "Frames after which one of them that was not seen again is dropped (T: replay_sequence, rooms).", Range{1, 100000});
  }
  /// Throws InvalidSettings naming the field, its value and its range.
  void validate() const { validate_settings(*this); }
};

/// The candidates of one spell of being lost.
///
/// Each holds log odds: the sum over views of the log odds that refinement gives the pose in them. Frames that look alike say the same
/// thing, so that a view counts only once the camera has moved since the last one that did; until then the less favourable of the two
/// stands. Reference: sequential evidence [Wald1947]; multiple hypotheses carried by odometry, as in Monte Carlo localisation
/// [Dellaert1999].
class PoseCandidates {
 public:
  /// @throws InvalidSettings
  explicit PoseCandidates(const PoseCandidatesSettings& settings = {}) : settings_(settings) { settings.validate(); }

  /// Whether no pose is carried along.
  bool empty() const { return candidates_.empty(); }
  /// Forgets all poses.
  void clear() { candidates_.clear(); }

  /// Moves all with the camera. @param previous_from_current  The camera's motion since the last frame.
  void move(const SE3& previous_from_current);

  /// Where to look for the camera, besides where the relocaliser says: the most likely first, without any confidence of their own.
  std::vector<PoseEstimate> proposals() const;

  /// Takes what refinement made of proposals in the current frame, best first, of which those that it finds hopeless speak against their
  /// candidate and make no new one.
  void weigh(Span<const RefinedPose> refined);

  /// Whether no other pose than this one has more weight.
  bool is_likeliest(const SE3& world_from_camera) const;
  /// The pose that stands alone: enough views speak for it, and for no other nearly as much; nullptr if there is none.
  const SE3* standing_alone() const;

 private:
  struct Candidate {
    SE3 world_from_camera;
    SE3 counted_world_from_camera;  ///< at the last view that counted
    float log_odds = 0.0F;          ///< without that of the last view
    float last_view = 0.0F;         ///< log odds
    int num_views = 1;
    int num_frames_unseen = 0;
    bool is_weighed = false;  ///< in this frame

    float total() const { return log_odds + last_view; }
  };

  Candidate* find(const SE3& world_from_camera);

  PoseCandidatesSettings settings_;
  std::vector<Candidate> candidates_;  ///< most likely first
};

}  // namespace foothold

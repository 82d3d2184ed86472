// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// Protocol: the camera is suddenly elsewhere. Which frames are shown, and how what a system makes of them is judged.
///
/// Nothing here knows the system: callers play the steps to it and note what came of each.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "foothold/base/se3.h"
#include "foothold/base/span.h"
#include "foothold/evaluation/pose_error.h"

namespace foothold {

/// How the camera is taken elsewhere.
enum class KidnapKind {
  kRemoved,   ///< a stretch of frames is left out
  kTeleport,  ///< back to an earlier part of the recording
  kReturn,    ///< from there to where the teleport began
  kBlackout,  ///< the lens is covered while the camera moves on
  kLeap       ///< ahead to a later part of the recording, which is not mapped yet but may look like what is; then back
};

/// For people and files: "removed", "teleport", "return", "blackout", "leap".
const char* to_string(KidnapKind kind);

/// A break in the camera's path.
struct Kidnap {
  KidnapKind kind = KidnapKind::kRemoved;  ///< what happens to the camera
  int from = 0;                            ///< the frame that would have come next
  int num_covered = 0;                     ///< frames from there on that are shown with the lens covered
  int to = 0;                              ///< the frame shown after that
};

/// A frame to show.
struct PlayStep {
  int frame = 0;         ///< index in the recording
  bool covered = false;  ///< with the lens covered: no depth, black colour
  int kidnap = -1;       ///< index of the kidnap whose judged frames begin here, or -1
};

/// How many kidnaps of each kind are planned, how long they are, and how many frames judge each.
struct KidnapOptions {
  int num_removed = 0;      ///< stretches to leave out
  int removed_length = 60;  ///< frames of each
  int num_teleports = 0;    ///< jumps back, each with a return
  int teleport_gap = 60;  ///< a teleport leads at least so many frames back; at least a quarter of a recording shorter than four times that
  int num_blackouts = 0;  ///< stretches with the lens covered
  int blackout_length = 30;  ///< frames of each
  int num_leaps = 0;         ///< independent ones only: in one run, what was mapped ahead would be known for good
  int leap_gap = 40;         ///< a leap leads at least so many frames ahead
  int num_judged = 30;       ///< frames after a kidnap by which it is judged
  int num_first = 100;       ///< frames before the first kidnap; a quarter of a recording that is shorter than four times that
  std::uint64_t seed = 42;   ///< of the places of the kidnaps

  /// All kidnaps, without the returns from teleports.
  int num_kidnaps() const { return num_removed + num_teleports + num_blackouts + num_leaps; }
  /// Throws InvalidSettings naming the field, its value and what is allowed.
  void validate() const;
};

/// A run with all kidnaps in it.
struct KidnapPlan {
  std::vector<Kidnap> kidnaps;  ///< as met; each teleport is followed by its return
  std::vector<PlayStep> steps;  ///< what to show, in order
};

/// Plays a recording once, with all kidnaps at random places, none within the judged frames of another. After a teleport, the judged frames
/// are played from there, then the camera returns.
/// @throws InvalidSettings if the kidnaps do not fit into the recording.
KidnapPlan plan_sequential_kidnaps(int num_frames, const KidnapOptions& options);

/// Kidnaps out of an undisturbed run, each alone, by rising `from`: random places, spread over the recording.
/// @throws InvalidSettings if one does not fit into the recording.
std::vector<Kidnap> plan_independent_kidnaps(int num_frames, const KidnapOptions& options);

/// What is shown from a kidnap on, to a copy of the state before frame `from`: covered frames, then those by which it is judged. After a
/// leap, these are as many from before it as from where it led to.
std::vector<PlayStep> independent_steps(const Kidnap& kidnap, int num_frames, const KidnapOptions& options);

/// What a system made of a frame.
struct PlayedFrame {
  std::optional<SE3> world_from_camera;  ///< the pose it gave; empty while lost
  bool believed = false;                 ///< it judged the pose good
  bool fused = false;                    ///< it changed its map with it
  double duration_ms = 0.0;              ///< the system's time for the frame [ms]
};

/// Poses nearer than this to the reference are right: the limits at which a tracker started there converges.
inline constexpr PoseThreshold kResumedThreshold = kWrongThreshold;

/// How a kidnap ended.
struct KidnapOutcome {
  int num_judged = 0;          ///< frames with a reference; without any, nothing can be said
  bool recovered = false;      ///< a right and believed pose came within the judged frames
  bool right_at_end = false;   ///< the last judged frame has a right pose
  int num_frames = 0;          ///< to recovery, that of recovery included: 1 is at once; 0 without one
  double duration_ms = 0.0;    ///< the system's time for these frames
  int num_wrong = 0;           ///< frames with a wrong pose, believed or not
  int num_wrong_believed = 0;  ///< wrong frames that the system judged good
  int num_wrong_fused = 0;     ///< wrong frames that changed the map
};

/// Judges the frames after a kidnap.
/// @param reference  The right pose of each frame in the system's own world: that of the undisturbed run, so that drift of the true poses
///                   against the map does not count. Frames without one are not judged.
/// @pre Equal sizes.
KidnapOutcome judge_kidnap(Span<const PlayedFrame> played, Span<const std::optional<SE3>> reference);

/// Outcomes of one kind of kidnap, of those that could be judged.
struct KidnapSummary {
  int num_kidnaps = 0;                      ///< that could be judged
  int num_recovered = 0;                    ///< with a right and believed pose within the judged frames
  int num_right_at_end = 0;                 ///< with a right pose at the last judged frame
  int num_kidnaps_with_wrong = 0;           ///< with a wrong pose at least once
  int num_kidnaps_with_wrong_believed = 0;  ///< resumed wrongly at least once
  int num_wrong = 0;                        ///< frames, as are the two below
  int num_wrong_believed = 0;               ///< wrong frames that the system judged good
  int num_wrong_fused = 0;                  ///< wrong frames that changed the map
  double median_frames = 0.0;               ///< to recovery, over the recovered; NaN without one, as are the two below
  double p95_frames = 0.0;                  ///< the 95th percentile of these frames
  double median_ms = 0.0;                   ///< the median of the system's time to recovery [ms]
};

/// Counts outcomes. Those without judged frames are left out.
KidnapSummary summarise_kidnaps(const std::vector<KidnapOutcome>& outcomes);

}  // namespace foothold

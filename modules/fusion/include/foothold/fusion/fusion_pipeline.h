// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// A whole reconstruction: tracks, relocalises, refines, fuses and trains, frame by frame.
#pragma once

#include <algorithm>
#include <optional>
#include <vector>

#include "foothold/fusion/pose_candidates.h"
#include "foothold/fusion/pose_refiner.h"
#include "foothold/fusion/recovery_policy.h"

namespace foothold {

/// Settings of a FusionPipeline and of its parts.
struct FusionSettings {
  TsdfSettings volume;                ///< of the map
  RecoverySettings recovery;          ///< of what happens when tracking is lost
  PoseCandidatesSettings candidates;  ///< of the poses that a lost camera carries along
  PoseRefinerSettings refiner;        ///< of the refinement of proposals
  /// The map is rendered for tracking in images reduced by this divisor.
  int render_divisor = 4;
  /// Tracking of a frame that moved further than this since the last has failed: ICP may have snapped to another place, such as the next of
  /// equal steps.
  float max_motion_m = 0.2F;
  float max_motion_deg = 15.0F;  ///< likewise [deg]
  /// A frame whose view the acceptance classifier gives less than this probability counts as poorly tracked at best. The classifier's
  /// probabilities hold if right and wrong poses are equally frequent; tracked ones are nearly always right, so that much less than a half
  /// is still good.
  float min_view_probability = 0.2F;

  /// Shows each field to the visitor, with its name, what it means and its range.
  template <class Visitor>
  static void fields(Visitor& v) {
    v(&FusionSettings::volume, "volume");
    v(&FusionSettings::recovery, "recovery");
    v(&FusionSettings::candidates, "candidates");
    v(&FusionSettings::refiner, "refiner");
    v(&FusionSettings::render_divisor, "render_divisor",
      "Reduction of the renderings that frames are tracked against (T: fusion_benchmark, kitchen).", Range{1, 16});
    v(&FusionSettings::max_motion_m, "max_motion_m",
      "Motion between frames beyond which tracking has failed [m] (T: replay_sequence, kitchen).", Range{0.001, 100.0});
    v(&FusionSettings::max_motion_deg, "max_motion_deg", "The same for rotation [deg] (T: replay_sequence, kitchen).", Range{0.01, 180.0});
    v(&FusionSettings::min_view_probability, "min_view_probability",
      "Probability below which a view is doubted (T: fusion_benchmark, teddy).", Range{0.0, 1.0});
  }
  /// Throws InvalidSettings naming the field, its value and its range.
  void validate() const;
};

/// What became of a frame.
struct FusionFrameResult {
  RecoveryState state = RecoveryState::kTracking;      ///< after the frame
  TrackingQuality quality = TrackingQuality::kFailed;  ///< of tracking, or of the pose after relocalisation
  float quality_score = 0.0F;                          ///< of the tracking classifier; higher is better
  /// The camera's pose; empty while lost.
  std::optional<SE3> world_from_camera;
  /// Probability that the pose is right; 0 while lost.
  float confidence = 0.0F;
  bool relocaliser_asked = false;      ///< the relocaliser was asked for proposals
  bool relocalised = false;            ///< the pose is the relocaliser's, refined
  bool fused = false;                  ///< the frame changed the map
  int num_blocks_refused = 0;          ///< by the map when the frame was fused, for it was full
  float out_of_range_fraction = 0.0F;  ///< of the frame's depth, what the map's limits leave out; filled in by Reconstruction
  bool trained = false;                ///< the relocaliser learnt the frame
  ViewAgreement agreement;             ///< of the frame with the map at the pose, where the two were compared
  double track_ms = 0.0;               ///< of tracking [ms]
  double relocalise_ms = 0.0;          ///< of finding and refining proposals [ms]
  double fuse_ms = 0.0;                ///< of changing the map [ms]
  double train_ms = 0.0;               ///< of the relocaliser's learning, as far as the frame waited for it [ms]
  double render_ms = 0.0;              ///< of rendering the map [ms]
  double total_ms = 0.0;               ///< of the whole frame [ms]
};

/// Drives the parts as RecoveryPolicy says. While lost, the map and the relocaliser never change; frames are tracked against each other, so
/// that what several views say about where the camera may be adds up (PoseCandidates): a place that one view leaves in doubt is found once
/// something distinctive comes into view, and one that only looks alike is not believed. When lost, the last known pose is a
/// candidate, too: a camera that was covered for a moment is found again even without a relocaliser.
///
/// In a frame that is fused, the relocaliser is given the frame once its pose is known; then the map is changed and rendered for the next.
/// A BackgroundRelocaliser takes a copy of the frame and learns it beside all that, and beside the tracking of the next frame: it is waited
/// for when it is given another frame or asked for proposals. Its host waits for it before using what it wraps. Results are the same.
///
/// Copies are independent but for the relocaliser, which is the caller's.
class FusionPipeline : public Persistent {
 public:
  /// @param relocaliser  Trained on good frames and asked when lost; nullptr for tracking alone. Must outlive the pipeline. Its proposals
  ///                     are refined here: pass the bare relocaliser, not a RefiningRelocaliser.
  /// @throws InvalidSettings
  FusionPipeline(const Context& context, const FusionSettings& settings, Relocaliser* relocaliser);
  /// Copies the map, the pose and the state of recovery, to go on with another relocaliser.
  FusionPipeline(const FusionPipeline& other, Relocaliser* relocaliser);
  ~FusionPipeline() override;
  /// What was moved from may only be assigned to or destroyed.
  FusionPipeline(FusionPipeline&&) noexcept;
  /// What was moved from may only be assigned to or destroyed.
  FusionPipeline& operator=(FusionPipeline&&) noexcept;

  /// Sets the pose of the first frame; the identity otherwise. @pre No frame was processed since construction or reset().
  void start_at(const SE3& world_from_camera);

  /// Takes the next frame. The first with depth starts the map. Malformed frames, those without depth in range, and those with a side
  /// shorter than least_side_px() count as lost ones, about which nobody is asked.
  /// @pre The frame's images live in the context's memory.
  FusionFrameResult process(const Frame& frame);

  /// Makes tracking of the next frame fail, whatever it shows: for tests and benchmarks.
  void force_loss() { loss_forced_ = true; }

  /// Forgets map, pose and state, and resets the relocaliser.
  void reset();

  /// Writes map and pose; the relocaliser is saved by its owner. @throws FileError if writing fails.
  void save(std::ostream& stream) const override;
  /// Goes on with a saved map. The camera counts as lost until the relocaliser, with what it had learnt, finds it in that map. On failure
  /// nothing changes. @throws FileError for a damaged stream, another version, or a map made with other settings of the volume.
  void load(std::istream& stream) override;

  /// The map.
  const TsdfVolume& volume() const { return volume_; }
  /// The rendering that the next frame is tracked against, with colour; empty before the first frame.
  const SurfaceMap& rendering() const { return rendering_; }
  /// Tracking, lost or settling, after the last frame.
  RecoveryState state() const { return policy_.state(); }
  /// As given to the constructor.
  const FusionSettings& settings() const { return settings_; }
  /// Of images that are smaller, nothing would be left to render.
  int least_side_px() const { return std::max(settings_.render_divisor, settings_.refiner.coarse_divisor); }

 private:
  /// What is known of a frame's pose before the policy decides.
  struct Sighting {
    TrackingQuality tracked = TrackingQuality::kFailed;
    SE3 tracked_world_from_camera;
    RelocalisationOutcome outcome = RelocalisationOutcome::kNotAsked;
    RefinedPose found;         ///< if the outcome is a pose
    bool is_new_view = false;  ///< the map explains the frame from another place than that of the last that it explained
  };

  void start(const Frame& frame, FusionFrameResult& result);
  void follow(const Frame& frame, bool usable, bool may_track, FusionFrameResult& result);
  void track(const Frame& frame, Sighting& sighting, FusionFrameResult& result);
  TrackingResult align(IcpResiduals residuals, ViewAgreement& agreement);
  void relocalise(const Frame& frame, Sighting& sighting, FusionFrameResult& result);
  std::vector<PoseEstimate> propose(const Frame& frame, bool is_lost, FusionFrameResult& result);
  void carry_candidates();
  const RefinedPose* choose(Span<const RefinedPose> refined, bool is_lost);
  void fuse(const Frame& frame, FusionFrameResult& result);
  void train(const Frame& frame, FusionFrameResult& result);
  void render(const Frame& frame, FusionFrameResult& result);

  Context context_;
  FusionSettings settings_;
  Relocaliser* relocaliser_;
  TsdfVolume volume_;
  Raycaster raycaster_;
  IcpTracker icp_;
  ViewComparer comparer_;
  PoseRefiner refiner_;
  RecoveryPolicy policy_;
  PoseCandidates candidates_;
  SurfaceMap rendering_;
  SurfaceMap lost_surface_;          // of the last frame, while lost
  Array<SE3> guess_;                 // of the pose to be tracked
  SE3 explained_world_from_camera_;  // of the last view that the map explained
  SE3 world_from_camera_;
  bool started_ = false;
  bool loss_forced_ = false;
};

}  // namespace foothold

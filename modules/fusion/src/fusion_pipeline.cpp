// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "foothold/fusion/fusion_pipeline.h"

#include <algorithm>

#include "foothold/base/contract.h"

namespace foothold {
namespace {

/// Between two frames of a lost camera, within which tracking them against each other is believed (T: replay_sequence, rooms).
constexpr float kMaxLostMotionM = 0.3F;
constexpr float kMaxLostMotionDeg = 20.0F;
constexpr float kMinLostInliers = 0.6F;

}  // namespace

void FusionSettings::validate() const {
  validate_settings(*this);
  volume.validate();
  recovery.validate();
  candidates.validate();
  refiner.validate();
}

FusionPipeline::FusionPipeline(const Context& context, const FusionSettings& settings, Relocaliser* relocaliser)
    : context_(context),
      settings_(settings),
      relocaliser_(relocaliser),
      volume_(context, settings.volume),
      raycaster_(context),
      icp_(context, IcpLevels::for_divisor(settings.render_divisor), settings.volume.depth_range()),
      comparer_(context, settings.volume.depth_range()),
      refiner_(context, settings.refiner, settings.volume.depth_range()),
      policy_(settings.recovery),
      candidates_(settings.candidates),
      rendering_(context.memory()),
      lost_surface_(context.memory()),
      guess_(context.memory()) {
  settings.validate();
}

FusionPipeline::FusionPipeline(const FusionPipeline& other, Relocaliser* relocaliser)
    : FusionPipeline(other.context_, other.settings_, relocaliser) {
  volume_ = other.volume_;
  policy_ = other.policy_;
  candidates_ = other.candidates_;
  rendering_ = other.rendering_;
  lost_surface_ = other.lost_surface_;
  world_from_camera_ = other.world_from_camera_;
  explained_world_from_camera_ = other.explained_world_from_camera_;
  started_ = other.started_;
  loss_forced_ = other.loss_forced_;
}

FusionPipeline::~FusionPipeline() = default;
FusionPipeline::FusionPipeline(FusionPipeline&&) noexcept = default;
FusionPipeline& FusionPipeline::operator=(FusionPipeline&&) noexcept = default;

void FusionPipeline::start_at(const SE3& world_from_camera) {
  FOOTHOLD_EXPECTS(!started_);
  FOOTHOLD_EXPECTS_NO_ERROR(describe_pose_error(world_from_camera));
  world_from_camera_ = world_from_camera;
}

void FusionPipeline::reset() {
  volume_.reset();
  policy_.reset();
  candidates_.clear();
  rendering_ = SurfaceMap(context_.memory());
  lost_surface_ = SurfaceMap(context_.memory());
  world_from_camera_ = SE3{};
  started_ = false;
  loss_forced_ = false;
  if (relocaliser_ != nullptr) relocaliser_->reset();
}

FusionFrameResult FusionPipeline::process(const Frame& frame) {
  const Stopwatch total;
  FusionFrameResult result;
  const bool usable = describe_frame_error(frame).empty() && std::min(frame.depth.width, frame.depth.height) >= least_side_px();
  const bool may_track = !loss_forced_;
  loss_forced_ = false;
  if (started_) {
    follow(frame, usable, may_track, result);
  } else if (usable) {
    start(frame, result);
  } else {
    result.state = RecoveryState::kLost;
  }
  result.total_ms = total.elapsed_ms();
  return result;
}

/// The first frame defines the map, unless there is nothing on it.
void FusionPipeline::start(const Frame& frame, FusionFrameResult& result) {
  fuse(frame, result);
  if (volume_.num_blocks() == 0) {
    volume_.reset();
    result = {};
    result.state = RecoveryState::kLost;
    return;
  }
  train(frame, result);
  started_ = true;
  result.quality = TrackingQuality::kGood;
  result.confidence = 1.0F;
  result.world_from_camera = world_from_camera_;
  render(frame, result);
}

void FusionPipeline::follow(const Frame& frame, bool usable, bool may_track, FusionFrameResult& result) {
  Sighting sighting;
  if (usable && may_track && policy_.should_track()) track(frame, sighting, result);
  if (policy_.should_relocalise(sighting.tracked)) {
    sighting.outcome = RelocalisationOutcome::kNothing;
    if (usable) relocalise(frame, sighting, result);
  }
  const RecoveryDecision decision = policy_.update(sighting.tracked, sighting.outcome, sighting.is_new_view);
  result.state = decision.state;
  if (decision.pose == PoseSource::kNone) {
    result.confidence = 0.0F;
    return;
  }
  result.relocalised = decision.pose == PoseSource::kRelocaliser;
  world_from_camera_ = result.relocalised ? sighting.found.world_from_camera : sighting.tracked_world_from_camera;
  candidates_.clear();
  if (result.relocalised || sighting.is_new_view) explained_world_from_camera_ = world_from_camera_;
  result.world_from_camera = world_from_camera_;
  if (decision.fuse) {
    train(frame, result);  // first: it may go on beside the rest
    fuse(frame, result);
  }
  render(frame, result);
}

void FusionPipeline::track(const Frame& frame, Sighting& sighting, FusionFrameResult& result) {
  const Stopwatch watch;
  guess_.assign(context_, Span<const SE3>(&world_from_camera_, 1));
  icp_.set_frame(frame);
  comparer_.set_frame(frame);
  ViewAgreement agreement;
  TrackingResult tracked = align(IcpResiduals::kDepth, agreement);
  if (IcpTracker::needs_greys(rendering_, tracked)) tracked = align(IcpResiduals::kDepthAndGrey, agreement);
  const TrackingGrade grade = grade_tracking(tracked.measures);
  result.quality = grade.quality;
  result.quality_score = grade.score;
  result.confidence = grade.probability;
  if (grade.quality != TrackingQuality::kFailed) {
    result.agreement = agreement;
    const RefinedPose view = refiner_.rate(tracked.measures, result.agreement);
    result.confidence = std::min(result.confidence, view.probability);
    const bool has_jumped = !is_near(tracked.world_from_camera, world_from_camera_, settings_.max_motion_m, settings_.max_motion_deg);
    if (view.probability < settings_.min_view_probability || (policy_.is_unconfirmed() && view.contradicted)) {
      result.quality = TrackingQuality::kPoor;
    }
    if (has_jumped || refiner_.is_hopeless(view)) result.quality = TrackingQuality::kFailed;
    sighting.is_new_view = result.quality == TrackingQuality::kGood && view.probability > refiner_.acceptance_probability() &&
                           !is_near(tracked.world_from_camera, explained_world_from_camera_, kNewViewM, kNewViewDeg);
  }
  sighting.tracked = result.quality;
  sighting.tracked_world_from_camera = tracked.world_from_camera;
  result.track_ms = watch.elapsed_ms();
}

/// Aligns the frame with the rendering and compares the two. All is asked for before the host waits for it, once.
TrackingResult FusionPipeline::align(IcpResiduals residuals, ViewAgreement& agreement) {
  icp_.align_all(rendering_, guess_, residuals);
  comparer_.compare_all(rendering_, icp_.world_from_cameras());
  HostReads reads;
  icp_.queue_results(reads);
  comparer_.queue_results(reads);
  reads.wait(context_);
  agreement = comparer_.results().front();
  return icp_.results().front();
}

/// Asks the relocaliser, and the map whether to believe it; neither about a frame without depth.
void FusionPipeline::relocalise(const Frame& frame, Sighting& sighting, FusionFrameResult& result) {
  const ScopedStage stage(context_, "fusion/relocalise");
  const Stopwatch watch;
  const bool is_lost = sighting.tracked == TrackingQuality::kFailed;
  icp_.set_frame(frame);
  if (!icp_.sees_depth()) return;
  if (is_lost) carry_candidates();
  const std::vector<RefinedPose> refined = refiner_.refine(frame, volume_, propose(frame, is_lost, result));
  const RefinedPose* const chosen = choose(refined, is_lost);
  result.relocalise_ms = watch.elapsed_ms();
  if (chosen == nullptr) return;
  const RefinedPose& found = *chosen;
  const TrackingGrade grade = grade_tracking(found.measures);
  if (grade.quality != TrackingQuality::kGood) return;
  if (sighting.tracked != TrackingQuality::kFailed) {
    if (is_near(found.world_from_camera, sighting.tracked_world_from_camera, kSamePoseM, kSamePoseDeg)) {
      sighting.outcome = RelocalisationOutcome::kConfirms;
      return;
    }
    // A second opinion overrules tracking only if it explains the frame better than the pose being tracked does.
    if (found.score <= refiner_.refine_one(frame, volume_, sighting.tracked_world_from_camera).score) return;
  }
  sighting.outcome = RelocalisationOutcome::kElsewhere;
  sighting.found = found;
  result.quality = grade.quality;
  result.quality_score = grade.score;
  result.confidence = found.probability;
  result.agreement = found.agreement;
}

/// Moves the candidates with the camera, as far as this frame can be tracked against the last; forgets them where it cannot.
void FusionPipeline::carry_candidates() {
  if (candidates_.empty() || lost_surface_.empty()) return;
  const TrackingResult motion = icp_.track(lost_surface_, SE3{});
  const bool is_tracked = motion.measures.well_posed && motion.measures.inlier_fraction >= kMinLostInliers &&
                          is_near(motion.world_from_camera, SE3{}, kMaxLostMotionM, kMaxLostMotionDeg);
  if (is_tracked) {
    candidates_.move(motion.world_from_camera);  // the world of the last frame's surface is that frame's camera
  } else {
    candidates_.clear();
  }
}

/// Where the camera may be: where the relocaliser says, where earlier views left it, and, if lost, where it was last.
std::vector<PoseEstimate> FusionPipeline::propose(const Frame& frame, bool is_lost, FusionFrameResult& result) {
  std::vector<PoseEstimate> carried = is_lost ? candidates_.proposals() : std::vector<PoseEstimate>{};
  if (is_lost) carried.push_back({world_from_camera_, 0.0F});
  std::vector<PoseEstimate> proposals;
  if (relocaliser_ != nullptr) {
    result.relocaliser_asked = true;
    proposals = relocaliser_->relocalise(frame);
  }
  const std::size_t room = kMaxProposals > carried.size() ? kMaxProposals - carried.size() : 1;
  if (proposals.size() > room) proposals.resize(room);
  proposals.insert(proposals.end(), carried.begin(), carried.end());
  return proposals;
}

/// The pose to believe: one that this view alone settles, unless earlier views speak for another, or one that all of them settle.
const RefinedPose* FusionPipeline::choose(Span<const RefinedPose> refined, bool is_lost) {
  if (refined.empty()) return nullptr;
  const RefinedPose* const best = refined.data();
  if (!is_lost) return best->accepted ? best : nullptr;
  candidates_.weigh(refined);
  const RefinedPose* chosen = best->accepted && candidates_.is_likeliest(best->world_from_camera) ? best : nullptr;
  if (const SE3* const alone = candidates_.standing_alone(); chosen == nullptr && alone != nullptr) {
    for (const RefinedPose& pose : refined) {
      if (chosen == nullptr && is_near(pose.world_from_camera, *alone, kSamePoseM, kSamePoseDeg)) chosen = &pose;
    }
  }
  icp_.make_surface(lost_surface_);
  return chosen;
}

void FusionPipeline::fuse(const Frame& frame, FusionFrameResult& result) {
  const Stopwatch watch;
  result.num_blocks_refused = volume_.integrate(frame, world_from_camera_).num_blocks_refused;
  result.fused = true;
  result.fuse_ms = watch.elapsed_ms();
}

void FusionPipeline::train(const Frame& frame, FusionFrameResult& result) {
  if (relocaliser_ == nullptr) return;
  const Stopwatch watch;
  relocaliser_->train(frame, world_from_camera_);
  relocaliser_->update();
  result.trained = true;
  result.train_ms = watch.elapsed_ms();
}

void FusionPipeline::render(const Frame& frame, FusionFrameResult& result) {
  const Stopwatch watch;
  const RenderCamera camera{frame.calibration.depth, frame.depth.width, frame.depth.height, world_from_camera_};
  raycaster_.render(volume_, camera.reduced(settings_.render_divisor), rendering_, true);
  result.render_ms = watch.elapsed_ms();
}

}  // namespace foothold

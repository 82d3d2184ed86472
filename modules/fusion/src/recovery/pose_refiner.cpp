// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "foothold/fusion/pose_refiner.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "foothold/base/error.h"

namespace foothold {

namespace {
/// PoseEstimate::confidence speaks of poses as near to the truth as this.
constexpr float kConfidentWithinM = 0.10F;
constexpr float kConfidentWithinDeg = 10.0F;

bool is_same(const SE3& a, const SE3& b) { return is_near(a, b, kSamePoseM, kSamePoseDeg); }

/// Distance between starts along the loosest direction [m] (T: relocalisation_benchmark, kitchen).
constexpr float kSlideStepM = 0.15F;

/// Of acceptance_features().
constexpr std::size_t kColourFeatures[] = {7, 8, 9};
/// Below this probability a pose is hopeless, whatever the poor threshold says: rendered rooms, from which that stems, are kinder than real
/// ones. (T: relocalisation_benchmark, kitchen)
constexpr double kHopelessProbability = 0.02;

/// Of the pixels on the map, those that coarse alignment must have found a partner for, if a pose that looks hopeless is to be aligned
/// finely (T: relocalisation_benchmark, kitchen against teddy and rooms).
constexpr float kLeastHold = 0.3F;
/// A pose that slid has at least this part of the frame on the map (T: replay_sequence, kitchen, ferns: 0.57 and more).
constexpr float kLeastSlidOverlap = 0.5F;
/// A relocaliser that is surer than this that its proposal is wrong is believed; one of 0 says nothing (T: relocalisation_benchmark,
/// kitchen against teddy and rooms: 0.0001 and less).
constexpr float kDeniedConfidence = 2e-4F;

bool has_hold(const RefinedPose& pose) { return pose.agreement.overlap >= kMinOverlap && pose.measures.inlier_fraction >= kLeastHold; }

bool may_have_slid(const RefinedPose& pose, float confidence) {
  return pose.agreement.overlap >= kLeastSlidOverlap && (confidence == 0.0F || confidence > kDeniedConfidence);
}

ClassifierModel with_lenient_poor_threshold(ClassifierModel model) {
  const double score =
      (std::log(kHopelessProbability / (1.0 - kHopelessProbability)) - double{model.probability_offset}) / double{model.probability_scale};
  if (std::isfinite(score)) model.poor_threshold = std::min(model.poor_threshold, static_cast<float>(score));
  return model;
}

/// Whether colours were compared: not in the dark. Shapes alone do not tell places apart.
bool has_colour(const ViewAgreement& agreement) { return agreement.colour_correlation != 0.0F; }

int fine_divisor(const PoseRefinerSettings& settings) { return std::max(1, settings.coarse_divisor / 2); }

RenderCamera reduced_camera(const Frame& frame, int divisor) {
  return RenderCamera{frame.calibration.depth, frame.depth.width, frame.depth.height, SE3{}}.reduced(divisor);
}
}  // namespace

std::array<float, kNumAcceptanceFeatures> acceptance_features(const TrackingMeasures& measures, const ViewAgreement& agreement) {
  return {agreement.overlap,        agreement.agreement,          agreement.in_front,
          agreement.behind,         agreement.solid_in_front,     agreement.solid_behind,
          agreement.difference,     agreement.colour_correlation, agreement.texture_correlation,
          agreement.unlike_texture, measures.log_det_valid,       measures.residual_m,
          measures.inlier_fraction};
}

std::array<const char*, kNumAcceptanceFeatures> acceptance_feature_names() {
  return {"overlap",        "agreement",          "in_front",
          "behind",         "solid_in_front",     "solid_behind",
          "difference",     "colour_correlation", "texture_correlation",
          "unlike_texture", "log_det_valid",      "residual",
          "inlier_fraction"};
}

PoseRefiner::PoseRefiner(const Context& context, const PoseRefinerSettings& settings, const DepthRange& range,
                         const ClassifierModel& classifier)
    : context_(context),
      settings_(settings),
      classifier_(with_lenient_poor_threshold(classifier)),
      raycaster_(context),
      coarse_icp_(context, IcpLevels::for_divisor(settings.coarse_divisor), range),
      fine_icp_(context, IcpLevels::for_divisor(fine_divisor(settings)), range),
      comparer_(context, range),
      map_(context.memory()),
      proposals_(context.memory()) {
  settings.validate();
  FOOTHOLD_EXPECTS(classifier.features.size() == acceptance_feature_names().size());
}

bool PoseRefiner::is_good(const RefinedPose& pose) const { return pose.probability > acceptance_probability(); }

bool PoseRefiner::is_better(const RefinedPose& a, const RefinedPose& b) const {
  // The probability asks how much there is to go by, overlap and all, and whether that can be believed. Of two places that can, equal steps
  // of a staircase, the one where more of the map is in view is no better for that: only what tells them apart counts.
  if (!is_good(a) || !is_good(b)) return a.probability > b.probability;
  return a.agreement.texture_correlation > b.agreement.texture_correlation;
}

bool PoseRefiner::is_rival(const RefinedPose& other, const RefinedPose& best) const {
  const float unexplained = 1.0F - best.agreement.texture_correlation;
  const bool tells_apart = 1.0F - other.agreement.texture_correlation > settings_.ambiguity_ratio * unexplained;
  return is_good(other) && !tells_apart && !is_same(other.world_from_camera, best.world_from_camera);
}

float PoseRefiner::acceptance_probability() const { return classifier_.probability(classifier_.good_threshold); }

RefinedPose PoseRefiner::rate(const TrackingMeasures& measures, const ViewAgreement& agreement) const {
  RefinedPose result;
  result.measures = measures;
  result.agreement = agreement;
  result.contradicted = agreement.solid_behind > kMostSolidBehind;
  if (!measures.well_posed || agreement.overlap < kMinOverlap) {
    result.score = -std::numeric_limits<float>::infinity();
    return result;
  }
  std::array<float, kNumAcceptanceFeatures> features = acceptance_features(measures, agreement);
  if (!has_colour(agreement)) {  // a feature at its mean speaks neither for nor against
    for (const std::size_t i : kColourFeatures) features[i] = classifier_.features[i].mean;
  }
  result.score = classifier_.score(Span<const float>(features.data(), features.size()));
  result.probability = classifier_.probability(result.score);
  return result;
}

void PoseRefiner::attribute(Span<const PoseEstimate> proposals, int candidate, RefinedPose& pose) const {
  pose.candidate = candidate;
  const PoseEstimate& proposal = proposals[static_cast<std::size_t>(candidate)];
  if (!is_near(proposal.world_from_camera, pose.world_from_camera, kConfidentWithinM, kConfidentWithinDeg)) return;
  // In doubt it speaks neither for nor against: it proposed the pose all the same.
  if (!(proposal.confidence > 0.5F)) return;
  const float trust = std::min(proposal.confidence, kMaxTrust);
  const float odds = trust / (1.0F - trust);
  pose.probability = pose.probability * odds / (pose.probability * odds + 1.0F - pose.probability);
}

std::vector<RefinedPose> PoseRefiner::rate_rendered(IcpTracker& aligned) {
  comparer_.compare_all(map_, aligned.world_from_cameras());
  HostReads reads;
  aligned.queue_results(reads);
  comparer_.queue_results(reads);
  reads.wait(context_);
  const std::vector<TrackingResult> tracked = aligned.results();
  const std::vector<ViewAgreement> agreements = comparer_.results();
  std::vector<RefinedPose> results;
  for (std::size_t i = 0; i < tracked.size(); ++i) {
    results.push_back(rate(tracked[i].measures, agreements[i]));
    results.back().world_from_camera = tracked[i].world_from_camera;
    results.back().loosest_world = tracked[i].loosest_world;
  }
  return results;
}

std::vector<RefinedPose> PoseRefiner::align_coarsely(const Frame& frame, const TsdfVolume& volume, Span<const SE3> proposals) {
  proposals_.assign(context_, proposals);
  raycaster_.render_all(volume, reduced_camera(frame, settings_.coarse_divisor), proposals_, map_, true);
  coarse_icp_.align_all(map_, proposals_);
  return rate_rendered(coarse_icp_);
}

std::vector<RefinedPose> PoseRefiner::align_finely(const Frame& frame, const TsdfVolume& volume, Span<const SE3> proposals) {
  const RenderCamera camera = reduced_camera(frame, fine_divisor(settings_));
  proposals_.assign(context_, proposals);
  raycaster_.render_all(volume, camera, proposals_, map_);
  fine_icp_.align_all(map_, proposals_);
  // Again: the second rendering is from the aligned pose, so that nothing is hidden by parallax.
  raycaster_.render_all(volume, camera, fine_icp_.world_from_cameras(), map_, true);
  fine_icp_.align_all(map_, fine_icp_.world_from_cameras());
  return rate_rendered(fine_icp_);
}

RefinedPose PoseRefiner::refine_one(const Frame& frame, const TsdfVolume& volume, const SE3& proposal) {
  fine_icp_.set_frame(frame);
  comparer_.set_frame(frame);
  RefinedPose result = align_finely(frame, volume, Span<const SE3>(&proposal, 1)).front();
  result.accepted = has_colour(result.agreement) && is_good(result) && !result.contradicted;
  return result;
}

std::vector<RefinedPose> PoseRefiner::rank_coarsely(const Frame& frame, const TsdfVolume& volume, Span<const PoseEstimate> proposals) {
  std::vector<SE3> starts;
  std::vector<int> indices;
  for (std::size_t i = 0; i < proposals.size(); ++i) {
    const SE3& proposal = proposals[i].world_from_camera;
    if (std::any_of(starts.begin(), starts.end(), [&](const SE3& other) { return is_same(other, proposal); })) continue;
    starts.push_back(proposal);
    indices.push_back(static_cast<int>(i));
  }
  std::vector<RefinedPose> candidates = align_coarsely(frame, volume, starts);
  for (std::size_t i = 0; i < candidates.size(); ++i) attribute(proposals, indices[i], candidates[i]);
  std::stable_sort(candidates.begin(), candidates.end(), [&](const RefinedPose& a, const RefinedPose& b) { return is_better(a, b); });

  std::vector<RefinedPose> distinct;
  for (const RefinedPose& candidate : candidates) {
    if (distinct.size() == static_cast<std::size_t>(settings_.num_finalists)) break;
    const bool is_new = std::none_of(distinct.begin(), distinct.end(), [&](const RefinedPose& other) {
      return is_same(other.world_from_camera, candidate.world_from_camera);
    });
    if (is_new) distinct.push_back(candidate);
  }
  return distinct;
}

std::vector<RefinedPose> PoseRefiner::refine_finalists(const Frame& frame, const TsdfVolume& volume, Span<const PoseEstimate> proposals,
                                                       Span<const RefinedPose> ranked) {
  if (ranked.empty()) return {};
  std::vector<SE3> starts;
  for (const RefinedPose& candidate : ranked) starts.push_back(candidate.world_from_camera);
  std::vector<RefinedPose> finalists = align_finely(frame, volume, starts);
  for (std::size_t i = 0; i < finalists.size(); ++i) attribute(proposals, ranked[i].candidate, finalists[i]);
  return finalists;
}

std::vector<RefinedPose> PoseRefiner::refine_ranked(const Frame& frame, const TsdfVolume& volume, Span<const PoseEstimate> proposals) {
  if (proposals.empty()) return {};
  const std::vector<RefinedPose> ranked = rank_coarsely(frame, volume, proposals);
  const auto first_hopeless = std::find_if(ranked.begin(), ranked.end(), [&](const RefinedPose& pose) { return is_hopeless(pose); });
  const auto num_hopeful = static_cast<std::size_t>(first_hopeless - ranked.begin());
  const Span<const RefinedPose> all(ranked);
  std::vector<RefinedPose> finalists = refine_finalists(frame, volume, proposals, all.subspan(0, num_hopeful));
  if (std::none_of(finalists.begin(), finalists.end(), [&](const RefinedPose& pose) { return is_good(pose); })) {
    std::vector<RefinedPose> hopeless;
    for (const RefinedPose& pose : all.subspan(num_hopeful, ranked.size() - num_hopeful)) {
      (has_hold(pose) ? hopeless : finalists).push_back(pose);
    }
    for (const RefinedPose& pose : refine_finalists(frame, volume, proposals, hopeless)) {
      finalists.push_back(pose);
      if (is_good(pose)) break;  // hopeless ones behind it cannot rival what was found
    }
  }
  std::stable_sort(finalists.begin(), finalists.end(), [&](const RefinedPose& a, const RefinedPose& b) { return is_better(a, b); });
  return finalists;
}

std::vector<PoseEstimate> PoseRefiner::slide(const RefinedPose& pose) const {
  std::vector<PoseEstimate> starts;
  if (pose.loosest_world.isZero()) return starts;
  const int num_steps = static_cast<int>(std::lround(settings_.slide_reach_m / kSlideStepM));
  for (int i = 1; i <= num_steps; ++i) {
    const Eigen::Vector3f offset_world = static_cast<float>(i) * kSlideStepM * pose.loosest_world;
    for (const Eigen::Vector3f& offset : {offset_world, Eigen::Vector3f(-offset_world)}) {
      starts.push_back({pose.world_from_camera, 0.0F});
      starts.back().world_from_camera.translation += offset;
    }
  }
  return starts;
}

std::vector<RefinedPose> PoseRefiner::refine(const Frame& frame, const TsdfVolume& volume, Span<const PoseEstimate> proposals) {
  if (proposals.empty() || std::min(frame.depth.width, frame.depth.height) < settings_.coarse_divisor) return {};
  coarse_icp_.set_frame(frame);
  fine_icp_.set_frame(frame);
  comparer_.set_frame(frame);
  const std::size_t num_proposals = std::min(proposals.size(), kMaxProposals);
  std::vector<RefinedPose> finalists = refine_ranked(frame, volume, Span<const PoseEstimate>(proposals.data(), num_proposals));
  const int candidate = finalists.front().candidate;
  if (!is_good(finalists.front()) && may_have_slid(finalists.front(), proposals[static_cast<std::size_t>(candidate)].confidence)) {
    for (RefinedPose& slid : refine_ranked(frame, volume, slide(finalists.front()))) {
      if (!is_good(slid)) continue;  // what is in doubt wherever it slides is best left where the relocaliser saw it
      slid.candidate = candidate;
      finalists.push_back(slid);
    }
    std::stable_sort(finalists.begin(), finalists.end(), [&](const RefinedPose& a, const RefinedPose& b) { return is_better(a, b); });
  }

  RefinedPose& best = finalists.front();
  const bool is_ambiguous =
      std::any_of(finalists.begin() + 1, finalists.end(), [&](const RefinedPose& other) { return is_rival(other, best); });
  best.accepted = has_colour(best.agreement) && is_good(best) && !best.contradicted && !is_ambiguous;
  return finalists;
}

}  // namespace foothold

// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "foothold/fusion/pose_refiner.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "foothold/base/error.h"

namespace foothold {

namespace {
constexpr float kDegPerRad = 57.29578F;

/// Alignment that ends at the level of the pyramid whose pixels match those of an image reduced by a divisor, and begins one above.
IcpSettings at_divisor(IcpSettings settings, int divisor) {
  constexpr int kMostLevels = 6;
  const int level = static_cast<int>(std::lround(std::log2(static_cast<double>(divisor))));
  settings.finest_level = std::min(level, kMostLevels - 1);
  settings.coarsest_level = settings.finest_level + 1;
  return settings;
}

/// Of acceptance_features().
constexpr std::size_t kColourFeature = 5;
constexpr std::size_t kTextureFeature = 6;
/// Below this probability a pose is hopeless, whatever the poor threshold says: rendered rooms, from which that stems, are kinder than real
/// ones. (T: relocalisation_benchmark, kitchen)
constexpr double kHopelessProbability = 0.02;

ClassifierModel with_lenient_poor_threshold(ClassifierModel model) {
  const double score =
      (std::log(kHopelessProbability / (1.0 - kHopelessProbability)) - double{model.probability_offset}) / double{model.probability_scale};
  if (std::isfinite(score)) model.poor_threshold = std::min(model.poor_threshold, static_cast<float>(score));
  return model;
}

/// Whether colours were compared: not in the dark. Shapes alone do not tell places apart.
bool has_colour(const ViewAgreement& agreement) { return agreement.colour_correlation != 0.0F; }

bool scores_higher(const RefinedPose& a, const RefinedPose& b) { return a.score > b.score; }

RenderCamera camera_at(const Frame& frame, const SE3& world_from_camera, int divisor) {
  return RenderCamera{frame.calibration.depth, frame.depth.width, frame.depth.height, world_from_camera}.reduced(divisor);
}
}  // namespace

void PoseRefinerSettings::validate() const {
  validate_settings(*this);
  icp.validate();
  if (fine_divisor > coarse_divisor) {
    throw InvalidSettings("setting fine_divisor: got " + std::to_string(fine_divisor) + ", expected at most coarse_divisor, " +
                          std::to_string(coarse_divisor));
  }
}

std::array<float, kNumAcceptanceFeatures> acceptance_features(const TrackingMeasures& measures, const ViewAgreement& agreement) {
  return {agreement.overlap,
          agreement.agreement,
          agreement.in_front,
          agreement.behind,
          agreement.difference,
          agreement.colour_correlation,
          agreement.texture_correlation,
          measures.log_det_valid,
          measures.residual_m,
          measures.inlier_fraction};
}

std::array<const char*, kNumAcceptanceFeatures> acceptance_feature_names() {
  return {"overlap",       "agreement", "in_front",       "behind", "difference", "colour_correlation", "texture_correlation",
          "log_det_valid", "residual",  "inlier_fraction"};
}

PoseRefiner::PoseRefiner(const Context& context, const PoseRefinerSettings& settings, const ClassifierModel& classifier)
    : settings_(settings),
      classifier_(with_lenient_poor_threshold(classifier)),
      raycaster_(context),
      coarse_icp_(context, at_divisor(settings.icp, settings.coarse_divisor)),
      fine_icp_(context, at_divisor(settings.icp, settings.fine_divisor)),
      check_(context, settings.check),
      map_(context.memory()) {
  settings.validate();
  FOOTHOLD_EXPECTS(classifier.features.size() == acceptance_feature_names().size());
}

float PoseRefiner::acceptance_probability() const { return classifier_.probability(classifier_.good_threshold); }

bool PoseRefiner::is_same(const SE3& a, const SE3& b) const {
  return translation_distance_m(a, b) < settings_.same_pose_m && rotation_distance_rad(a, b) * kDegPerRad < settings_.same_pose_deg;
}

RefinedPose PoseRefiner::judge(const TrackingMeasures& measures, const ViewAgreement& agreement) const {
  RefinedPose result;
  result.measures = measures;
  result.agreement = agreement;
  if (!measures.well_posed || agreement.overlap < settings_.min_overlap) {
    result.score = -std::numeric_limits<float>::infinity();
    return result;
  }
  std::array<float, kNumAcceptanceFeatures> features = acceptance_features(measures, agreement);
  if (!has_colour(agreement)) {  // a feature at its mean speaks neither for nor against
    for (const std::size_t i : {kColourFeature, kTextureFeature}) features[i] = classifier_.features[i].mean;
  }
  result.score = classifier_.score(Span<const float>(features.data(), features.size()));
  result.probability = classifier_.probability(result.score);
  return result;
}

RefinedPose PoseRefiner::judge_rendered(const TrackingResult& tracked) {
  RefinedPose result = judge(tracked.measures, check_.compare(map_, tracked.world_from_camera));
  result.world_from_camera = tracked.world_from_camera;
  result.loosest_world = tracked.loosest_world;
  return result;
}

RefinedPose PoseRefiner::align_coarsely(const Frame& frame, const TsdfVolume& volume, const SE3& proposal) {
  raycaster_.render(volume, camera_at(frame, proposal, settings_.coarse_divisor), map_, true);
  return judge_rendered(coarse_icp_.track(map_, proposal));
}

RefinedPose PoseRefiner::align_finely(const Frame& frame, const TsdfVolume& volume, const SE3& proposal) {
  // Twice: the second rendering is from the aligned pose, so that nothing is hidden by parallax.
  raycaster_.render(volume, camera_at(frame, proposal, settings_.fine_divisor), map_);
  const TrackingResult first = fine_icp_.track(map_, proposal);
  if (!first.measures.well_posed) return judge_rendered(first);
  raycaster_.render(volume, camera_at(frame, first.world_from_camera, settings_.fine_divisor), map_, true);
  return judge_rendered(fine_icp_.track(map_, first.world_from_camera));
}

RefinedPose PoseRefiner::refine_one(const Frame& frame, const TsdfVolume& volume, const SE3& proposal) {
  fine_icp_.set_frame(frame);
  check_.set_frame(frame);
  RefinedPose result = align_finely(frame, volume, proposal);
  result.accepted = has_colour(result.agreement) && result.score > classifier_.good_threshold;
  return result;
}

std::vector<PoseEstimate> PoseRefiner::slide(const RefinedPose& pose) const {
  std::vector<PoseEstimate> starts;
  if (pose.loosest_world.isZero()) return starts;
  const int num_steps = static_cast<int>(std::lround(settings_.slide_reach_m / settings_.slide_step_m));
  for (int i = 1; i <= num_steps; ++i) {
    const Eigen::Vector3f offset_world = static_cast<float>(i) * settings_.slide_step_m * pose.loosest_world;
    for (const Eigen::Vector3f& offset : {offset_world, Eigen::Vector3f(-offset_world)}) {
      starts.push_back({pose.world_from_camera, 0.0F});
      starts.back().world_from_camera.translation += offset;
    }
  }
  return starts;
}

std::vector<RefinedPose> PoseRefiner::refine_ranked(const Frame& frame, const TsdfVolume& volume, Span<const PoseEstimate> proposals) {
  const auto contains = [&](const std::vector<RefinedPose>& poses, const SE3& pose) {
    return std::any_of(poses.begin(), poses.end(), [&](const RefinedPose& other) { return is_same(other.world_from_camera, pose); });
  };
  std::vector<RefinedPose> candidates;
  std::vector<SE3> seen;
  for (std::size_t i = 0; i < proposals.size(); ++i) {
    const SE3& proposal = proposals[i].world_from_camera;
    if (std::any_of(seen.begin(), seen.end(), [&](const SE3& other) { return is_same(other, proposal); })) continue;
    seen.push_back(proposal);
    RefinedPose aligned = align_coarsely(frame, volume, proposal);
    aligned.candidate = static_cast<int>(i);
    candidates.push_back(aligned);
  }
  std::stable_sort(candidates.begin(), candidates.end(), scores_higher);

  std::vector<RefinedPose> distinct;
  for (const RefinedPose& candidate : candidates) {
    if (distinct.size() == static_cast<std::size_t>(settings_.num_finalists)) break;
    if (!contains(distinct, candidate.world_from_camera)) distinct.push_back(candidate);
  }
  std::vector<RefinedPose> finalists;
  bool is_found = false;
  for (const RefinedPose& candidate : distinct) {
    if (is_found && is_hopeless(candidate)) break;  // those that follow score no better, and cannot rival what was found
    RefinedPose aligned = align_finely(frame, volume, candidate.world_from_camera);
    aligned.candidate = candidate.candidate;
    is_found = is_found || aligned.score > classifier_.good_threshold;
    finalists.push_back(aligned);
  }
  std::stable_sort(finalists.begin(), finalists.end(), scores_higher);
  return finalists;
}

std::vector<RefinedPose> PoseRefiner::refine(const Frame& frame, const TsdfVolume& volume, Span<const PoseEstimate> proposals) {
  if (proposals.empty()) return {};
  coarse_icp_.set_frame(frame);
  fine_icp_.set_frame(frame);
  check_.set_frame(frame);
  const std::size_t num_proposals = std::min(proposals.size(), static_cast<std::size_t>(settings_.max_candidates));
  std::vector<RefinedPose> finalists = refine_ranked(frame, volume, Span<const PoseEstimate>(proposals.data(), num_proposals));
  const auto is_good = [&](const RefinedPose& pose) { return pose.score > classifier_.good_threshold; };
  if (!is_good(finalists.front())) {
    const int candidate = finalists.front().candidate;
    for (RefinedPose& slid : refine_ranked(frame, volume, slide(finalists.front()))) {
      if (!is_good(slid)) continue;  // what is in doubt wherever it slides is best left where the relocaliser saw it
      slid.candidate = candidate;
      finalists.push_back(slid);
    }
    std::stable_sort(finalists.begin(), finalists.end(), scores_higher);
  }

  RefinedPose& best = finalists.front();
  best.accepted = has_colour(best.agreement) && is_good(best);
  for (std::size_t i = 1; i < finalists.size(); ++i) {
    const bool rivals = is_good(finalists[i]) && finalists[i].score > best.score - settings_.ambiguity_margin;
    if (rivals && !is_same(finalists[i].world_from_camera, best.world_from_camera)) best.accepted = false;
  }
  return finalists;
}

}  // namespace foothold

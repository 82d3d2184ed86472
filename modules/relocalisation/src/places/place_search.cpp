// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "places/place_search.h"

#include <algorithm>
#include <cmath>

#include "pose/confidence.h"
#include "pose/explain.h"

namespace foothold {
namespace {

// (T) docs/experiments/places.md
constexpr float kFewestVotes = 0.04F;        ///< share below which a place is hardly ever the right one
constexpr float kRivalVotes = 0.7F;          ///< of the highest share, from which a place may be mistaken for the other
constexpr std::size_t kMostPlaces = 3;       ///< upright attempts
constexpr std::size_t kMostRolledViews = 4;  ///< attempts of rolled cameras
constexpr float kSamePlaceM = 0.5F;          ///< poses nearer than this do not exclude each other

/// The estimates of one attempt, in the world's frame.
std::vector<PoseEstimate> estimates_of(const std::vector<PoseCandidate>& candidates, const Place& place) {
  std::vector<PoseEstimate> estimates;
  for (const PoseCandidate& candidate : candidates) {
    SE3 world_from_camera = place.world_from_camera(candidate.scene_from_camera);
    world_from_camera.rotation = nearest_rotation(world_from_camera.rotation);
    // Candidates behind the best were not aligned, and must not appear surer than it is.
    const float confidence = confidence_of(candidate);
    estimates.push_back({world_from_camera, estimates.empty() ? confidence : std::min(confidence, estimates.front().confidence)});
  }
  return estimates;
}

/// The answers of several attempts, as one.
class Answer {
 public:
  /// @return True if the estimates are better than all before.
  bool add(std::vector<PoseEstimate> estimates) {
    if (estimates.empty()) return false;
    const bool is_best = attempts_.empty() || estimates.front().confidence > attempts_.front().front().confidence;
    attempts_.insert(is_best ? attempts_.begin() : attempts_.end(), std::move(estimates));
    return is_best;
  }
  float confidence() const { return attempts_.empty() ? 0.0F : attempts_.front().front().confidence; }

  /// The best attempt's estimates with those of its rivals among them. Each attempt's confidence is the probability that it is right, were
  /// it the only one; of poses that exclude each other, at most one is: p_i = o_i / (1 + sum o_j), with the odds o = c / (1 - c).
  std::vector<PoseEstimate> combined(std::size_t num_candidates) {
    if (attempts_.empty()) return {};
    std::vector<PoseEstimate> estimates = std::move(attempts_.front());
    const PoseEstimate best = estimates.front();
    float sum_of_odds = odds(best.confidence);
    std::vector<PoseEstimate> rivals;
    for (std::size_t i = 1; i < attempts_.size(); ++i) {
      const PoseEstimate& rival = attempts_[i].front();
      if ((rival.world_from_camera.translation - best.world_from_camera.translation).norm() < kSamePlaceM) continue;
      sum_of_odds += odds(rival.confidence);
      rivals.push_back(rival);
    }
    const float scale = (1.0F + odds(best.confidence)) / (1.0F + sum_of_odds);
    for (PoseEstimate& estimate : estimates) estimate.confidence *= scale;
    for (PoseEstimate& rival : rivals) rival.confidence = odds(rival.confidence) / (1.0F + sum_of_odds);
    estimates.insert(estimates.end(), rivals.begin(), rivals.end());
    std::stable_sort(estimates.begin(), estimates.end(),
                     [](const PoseEstimate& a, const PoseEstimate& b) { return a.confidence > b.confidence; });
    if (estimates.size() > num_candidates) estimates.resize(num_candidates);
    return estimates;
  }

 private:
  static float odds(float confidence) { return confidence / std::max(1.0F - confidence, 1e-6F); }

  std::vector<std::vector<PoseEstimate>> attempts_;  ///< the best first
};

}  // namespace

PlaceSearch::PlaceSearch(const Context& context, const ForestRelocaliserSettings& settings)
    : sure_confidence_(settings.sure_confidence),
      num_candidates_(static_cast<std::size_t>(settings.pose.num_candidates)),
      votes_(context),
      estimator_(context, SearchPlan(settings.pose, settings.seed)) {}

std::vector<PoseEstimate> PlaceSearch::find(const Context& context, const PoseQuery& query, const DeviceForest& forest, ScenePlaces& places,
                                            Explanation* explanation) {
  std::vector<LeafModesView> modes;
  for (std::size_t i = 0; i < places.size(); ++i) modes.push_back(places[i].modes.view());
  Answer answer;
  const auto attempt = [&](const PlaceVote& vote) {
    Place& place = places[vote.place];
    const PlaceView view{place.reservoirs.view(), place.modes.view()};
    const std::vector<PoseEstimate> estimates = estimates_of(estimator_.estimate(context, query, view, forest.view(vote.roll)), place);
    if (answer.add(estimates) && explanation != nullptr) *explanation = explain(estimator_, estimates, place.origin_world);
  };

  estimator_.prepare(context, query);
  votes_.prepare(context, query);
  const std::vector<PlaceVote> upright = votes_.count(context, query, modes, {forest.view()}, 0);
  for (std::size_t i = 0; i < upright.size() && i < kMostPlaces; ++i) {
    const bool is_rival = upright[i].share >= kRivalVotes * upright.front().share;
    const bool is_likely = upright[i].share >= kFewestVotes && answer.confidence() < sure_confidence_;
    if (i == 0 || is_rival || is_likely) attempt(upright[i]);
  }

  std::vector<ForestView> rolled;
  for (int roll = 1; roll < forest.num_rolls(); ++roll) rolled.push_back(forest.view(roll));
  if (answer.confidence() < sure_confidence_) {
    const std::vector<PlaceVote> votes = votes_.count(context, query, modes, rolled, 1);
    for (std::size_t i = 0; i < votes.size() && i < kMostRolledViews; ++i) {
      if (votes[i].share < kFewestVotes || answer.confidence() >= sure_confidence_) break;
      attempt(votes[i]);
    }
  }
  return answer.combined(num_candidates_);
}

}  // namespace foothold

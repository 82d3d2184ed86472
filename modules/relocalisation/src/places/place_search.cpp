// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "places/place_search.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "foothold/base/trace.h"
#include "pose/confidence.h"
#include "pose/explain.h"

namespace foothold {
namespace {

// (T) docs/experiments/places.md
constexpr float kFewestVotes = 0.02F;                         ///< share below which a view is hardly ever of a place that was learnt
constexpr float kFamiliarVotes = 0.04F;                       ///< share from which a view is hardly ever of nowhere
constexpr float kLikelyVotes = 0.4F;                          ///< of the highest share, from which a place may be the right one
constexpr float kRivalVotes = 0.7F;                           ///< the same, from which a place may be mistaken for the other
constexpr std::size_t kMostPlaces = 5;                        ///< upright attempts
constexpr std::size_t kMostUnlikely = 8;                      ///< the same, where no place has many votes: most are given up early
constexpr std::size_t kMostRolledViews = 2;                   ///< attempts of rolled cameras; one, where no roll has many votes
constexpr float kFewestRolledVotes = 0.005F;                  ///< share below which they are hardly ever right
constexpr float kOtherLights[] = {0.45F, 0.67F, 1.5F, 2.2F};  ///< gains in which unfamiliar views are asked
constexpr float kBetterLight = 2.0F;                          ///< more votes in it by this factor
constexpr std::uint32_t kLightVoters = 128;                   ///< in each
constexpr float kSamePlaceM = 0.5F;                           ///< poses nearer than this do not exclude each other

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

/// What was found in one place.
struct Attempt {
  std::size_t place;
  std::vector<PoseEstimate> estimates;  ///< best first; not empty

  float confidence() const { return estimates.front().confidence; }
};

/// Beyond 0.9999 confidences differ by chance.
float odds_of(const Attempt& attempt) { return attempt.confidence() / std::max(1.0F - attempt.confidence(), 1e-4F); }

/// The best attempt's estimates, and the best of its rivals: what was found in other places, elsewhere. A confidence is the probability
/// that an attempt is right were it the only one; of places that exclude each other at most one is: p_i = o_i / (1 + sum o_j), with the
/// odds o = c / (1 - c). Rivals that are nearly as good must not be outdone by chance: theirs are raised half-way to the best's,
/// sqrt(o_j o_best).
/// @param num_untried  Rivals that were not tried: each may explain the frame as well as the best.
std::vector<PoseEstimate> combine(std::vector<Attempt> attempts, int num_untried, std::size_t num_candidates) {
  if (attempts.empty()) return {};
  std::stable_sort(attempts.begin(), attempts.end(), [](const Attempt& a, const Attempt& b) { return a.confidence() > b.confidence(); });
  const Attempt& best = attempts.front();
  std::vector<PoseEstimate> estimates = best.estimates;
  const SE3& best_pose = best.estimates.front().world_from_camera;
  std::vector<const Attempt*> rivals;
  for (const Attempt& attempt : attempts) {
    const float distance_m = (attempt.estimates.front().world_from_camera.translation - best_pose.translation).norm();
    if (attempt.place != best.place && distance_m > kSamePlaceM) rivals.push_back(&attempt);
  }
  if (rivals.empty() && num_untried == 0) return estimates;
  float sum_of_odds = static_cast<float>(1 + num_untried) * odds_of(best);
  const auto rival_odds = [&](const Attempt& rival) { return std::sqrt(odds_of(rival) * odds_of(best)); };
  for (const Attempt* rival : rivals) sum_of_odds += rival_odds(*rival);
  const float scale = odds_of(best) / (1.0F + sum_of_odds) / std::max(best.confidence(), 1e-6F);
  for (PoseEstimate& estimate : estimates) estimate.confidence *= scale;
  for (const Attempt* rival : rivals) {
    estimates.push_back({rival->estimates.front().world_from_camera, rival_odds(*rival) / (1.0F + sum_of_odds)});
  }
  std::stable_sort(estimates.begin(), estimates.end(),
                   [](const PoseEstimate& a, const PoseEstimate& b) { return a.confidence > b.confidence; });
  if (estimates.size() > num_candidates) estimates.resize(num_candidates);
  return estimates;
}

/// What was found so far.
class Attempts {
 public:
  Attempts(const Context& context, PoseEstimator& estimator, ScenePlaces& places, Explanation* explanation)
      : context_(context), estimator_(estimator), places_(places), explanation_(explanation) {}

  /// Estimates the pose in a place that was voted for. @pre The estimator is prepared for the query.
  void make(const PoseQuery& query, const PlaceVote& vote, const DeviceForest& forest) {
    Place& place = places_[vote.place];
    const PlaceView view{place.reservoirs.view(), place.modes.view(), Span<const ReservoirPoint>(place.latest)};
    std::vector<PoseEstimate> estimates = estimates_of(estimator_.estimate(context_, query, view, forest.view(vote.roll)), place);
    const float confidence = estimates.empty() ? 0.0F : estimates.front().confidence;
    if (attempts_.empty() || confidence > confidence_) {
      confidence_ = confidence;
      if (explanation_ != nullptr) *explanation_ = explain(estimator_, estimates, place.origin_world);
    }
    if (!estimates.empty()) attempts_.push_back({vote.place, std::move(estimates)});
  }

  float confidence() const { return confidence_; }  ///< the highest; 0 if there is none
  std::vector<Attempt> take() { return std::move(attempts_); }

 private:
  const Context& context_;
  PoseEstimator& estimator_;
  ScenePlaces& places_;
  Explanation* explanation_;
  std::vector<Attempt> attempts_;
  float confidence_ = 0.0F;
};

float most_votes(const std::vector<PlaceVote>& votes) { return votes.empty() ? 0.0F : votes.front().share; }

}  // namespace

PlaceSearch::PlaceSearch(const Context& context, const ForestRelocaliserSettings& settings)
    : sure_confidence_(settings.sure_confidence),
      max_ms_(static_cast<double>(settings.max_relocalise_ms)),
      num_candidates_(static_cast<std::size_t>(settings.pose.num_candidates)),
      votes_(context),
      estimator_(context, SearchPlan(settings.pose, settings.seed)),
      relit_(context) {}

const FeatureImage& PlaceSearch::find_light(const Context& context, const PoseQuery& query, const std::vector<LeafModesView>& places,
                                            const ForestView& forest, std::vector<PlaceVote>& votes) {
  const auto count = [&](float gain, std::uint32_t num_voters) {
    relit_.relight(context, query.image, gain);
    const PoseQuery relit{query.frame, relit_};
    votes_.prepare(context, relit);
    return votes_.count(context, relit, places, {forest}, 0, num_voters);
  };
  float best_gain = 1.0F;
  float to_beat = std::max(kFewestVotes, kBetterLight * most_votes(votes));
  for (const float gain : kOtherLights) {
    const float most = most_votes(count(gain, kLightVoters));
    if (most < to_beat) continue;
    to_beat = most;
    best_gain = gain;
  }
  if (best_gain == 1.0F) {
    votes_.prepare(context, query);
    return query.image;
  }
  votes = count(best_gain, kMostVoters);
  return relit_;
}

std::vector<PlaceVote> PlaceSearch::vote_rolled(const Context& context, const PoseQuery& query, const std::vector<LeafModesView>& places,
                                                const DeviceForest& forest) {
  std::vector<ForestView> rolled;
  for (int roll = 1; roll < forest.num_rolls(); ++roll) rolled.push_back(forest.view(roll));
  return votes_.count(context, query, places, rolled, 1, kMostVoters);
}

std::vector<PoseEstimate> PlaceSearch::find(const Context& context, const PoseQuery& as_seen, const DeviceForest& forest,
                                            ScenePlaces& places, Explanation* explanation) {
  const Stopwatch watch;
  const auto is_time_left = [&] { return max_ms_ <= 0.0 || watch.elapsed_ms() < max_ms_; };
  std::vector<LeafModesView> modes;
  for (std::size_t i = 0; i < places.size(); ++i) modes.push_back(places[i].modes.view());

  Attempts attempts(context, estimator_, places, explanation);
  int num_untried = 0;
  float most = 0.0F;
  const auto try_upright = [&](const PoseQuery& query, const std::vector<PlaceVote>& votes) {
    estimator_.prepare(context, query);
    most = most_votes(votes);
    num_untried = 0;
    const std::size_t most_places = most >= kFewestVotes ? kMostPlaces : kMostUnlikely;
    for (std::size_t i = 0; i < votes.size(); ++i) {
      const bool is_rival = votes[i].share >= kRivalVotes * most;
      const bool is_likely = votes[i].share >= kLikelyVotes * most && attempts.confidence() < sure_confidence_;
      const bool may_try = i < most_places && is_time_left();
      if (i == 0 || (may_try && (is_rival || is_likely))) {
        attempts.make(query, votes[i], forest);
      } else if (is_rival) {
        ++num_untried;
      }
    }
  };

  votes_.prepare(context, as_seen);
  std::vector<PlaceVote> upright = votes_.count(context, as_seen, modes, {forest.view()}, 0, kMostVoters);
  const bool is_unfamiliar = most_votes(upright) < kFamiliarVotes;
  const FeatureImage* image = &as_seen.image;
  const auto query = [&] { return PoseQuery{as_seen.frame, *image, is_unfamiliar}; };
  try_upright(query(), upright);
  if (most < kFewestVotes && attempts.confidence() < sure_confidence_ && is_time_left()) {
    image = &find_light(context, as_seen, modes, forest.view(), upright);
    if (image != &as_seen.image) try_upright(query(), upright);
  }
  if (attempts.confidence() < sure_confidence_ && is_time_left()) {
    const std::vector<PlaceVote> votes = vote_rolled(context, query(), modes, forest);
    const std::size_t most_rolled = most_votes(votes) >= kFewestVotes ? kMostRolledViews : 1;
    for (std::size_t i = 0; i < votes.size() && i < most_rolled; ++i) {
      if (votes[i].share < std::max(kFewestRolledVotes, most) || attempts.confidence() >= sure_confidence_ || !is_time_left()) break;
      attempts.make(query(), votes[i], forest);
    }
  }
  return combine(attempts.take(), num_untried, num_candidates_);
}

}  // namespace foothold

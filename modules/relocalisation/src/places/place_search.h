// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// Finds the camera of a frame in a scene of many places.
#pragma once

#include <vector>

#include "foothold/api/relocaliser.h"
#include "foothold/relocalisation/explanation.h"
#include "forest/device_forest.h"
#include "places/place_votes.h"
#include "places/scene_places.h"
#include "pose/pose_estimator.h"

namespace foothold {

/// Estimates poses in the places that the frame's pixels vote for, the likeliest first, until one is sure; then for rolled cameras. A view
/// with hardly any votes is asked in other lights, too.
///
/// Places that explain the frame about as well exclude each other: their confidences then sum to at most 1, so that neither is believed.
class PlaceSearch {
 public:
  PlaceSearch(const Context& context, const ForestRelocaliserSettings& settings);

  /// The likeliest place is always tried; whether time is left is asked before each other attempt.
  /// @param explanation  Output: what the answer was made from; nullptr for none.
  /// @return             Estimates, best first; empty if no place allows one.
  std::vector<PoseEstimate> find(const Context& context, const PoseQuery& query, const DeviceForest& forest, ScenePlaces& places,
                                 Explanation* explanation);

 private:
  /// Votes for an unfamiliar view in other lights.
  /// @param votes  Input and output: those for the view that is returned.
  /// @return       The view in the light in which it has more votes by far, or as it is. The voters are prepared for it.
  const FeatureImage& find_light(const Context& context, const PoseQuery& query, const std::vector<LeafModesView>& places,
                                 const ForestView& forest, std::vector<PlaceVote>& votes);

  /// Votes for rolled cameras.
  std::vector<PlaceVote> vote_rolled(const Context& context, const PoseQuery& query, const std::vector<LeafModesView>& places,
                                     const DeviceForest& forest);

  float sure_confidence_;
  double max_ms_;  ///< 0 for no limit
  std::size_t num_candidates_;
  PlaceVotes votes_;
  PoseEstimator estimator_;
  FeatureImage relit_;
};

}  // namespace foothold

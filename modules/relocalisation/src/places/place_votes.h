// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// Where first, then how: which places a frame may show, before any hypothesis is drawn. Pixels vote for the places in which their leaves
/// have modes of about their colour. Not in the paper, which knows one place.
#pragma once

#include <cstdint>
#include <vector>

#include "features/leaf_lookup.h"
#include "foothold/base/array.h"
#include "foothold/base/context.h"
#include "pose/pose_query.h"

namespace foothold {

/// A place as seen by a camera with one of the forest's rolls.
struct PlaceVote {
  std::size_t place = 0;
  int roll = 0;
  float share = 0.0F;  ///< how close the voters' leaves come to their colours, of what is possible: see closeness()
};

/// How many pixels vote if there are few places. (T) docs/experiments/places.md
inline constexpr std::uint32_t kMostVoters = 512;

/// Counts the votes of a frame.
///
/// Determinism: a function of the arguments alone.
class PlaceVotes {
 public:
  explicit PlaceVotes(const Context& context);

  /// Chooses the voters of a frame, evenly spread over it.
  void prepare(const Context& context, const PoseQuery& query);

  /// @param places       what is remembered of each.
  /// @param forests      turned to the rolls first_roll, first_roll + 1, ...
  /// @param most_voters  at most kMostVoters; fewer vote on many places.
  /// @return             A vote for each place and roll, the highest share first; equals stay in the order of rolls, then places.
  /// @pre prepare() was called with the same query.
  std::vector<PlaceVote> count(const Context& context, const PoseQuery& query, const std::vector<LeafModesView>& places,
                               const std::vector<ForestView>& forests, int first_roll, std::uint32_t most_voters);

 private:
  Array<SampledPixel> voters_;
  Array<std::uint32_t> leaves_;  ///< roll by roll, tree by tree
  Array<Rgb8> voter_colours_;
  Array<LeafModesView> places_;
  Array<float> shares_;  ///< roll by roll
};

}  // namespace foothold

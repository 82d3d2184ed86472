// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "places/place_votes.h"

#include <algorithm>

#include "foothold/base/exec/dispatch.h"
#include "places/place_votes_kernels.h"

namespace foothold {

#ifdef FOOTHOLD_HAS_CUDA
extern template struct VotingAlgorithms<CudaExecutor>;
#endif

namespace {
constexpr std::uint32_t kFewestVoters = 96;  ///< (T)
constexpr std::size_t kMostVotes = 32768;    ///< pairs of voter and view, beyond which fewer pixels vote
}  // namespace

PlaceVotes::PlaceVotes(const Context& context)
    : voters_(context.memory(), kMostVoters),
      leaves_(context.memory()),
      voter_colours_(context.memory(), kMostVoters),
      places_(context.memory()),
      shares_(context.memory()) {}

void PlaceVotes::prepare(const Context& context, const PoseQuery& query) {
  const ChooseVoter body{{query.frame.depth, 0.0F, 0.0F, kMostVoters, voters_.data()},
                         query.image.view(),
                         query.image.downscale(),
                         voters_.data(),
                         voter_colours_.data()};
  dispatch(context, [&](auto on) { VotingAlgorithms<typename decltype(on)::Executor>::choose(context, body, kMostVoters); });
}

std::vector<PlaceVote> PlaceVotes::count(const Context& context, const PoseQuery& query, const std::vector<LeafModesView>& places,
                                         const std::vector<ForestView>& forests, int first_roll, std::uint32_t most_voters) {
  const ScopedStage stage(context, "relocalise/vote");
  if (forests.empty() || places.empty()) return {};
  const int num_trees = forests.front().num_trees;
  const auto num_voters = static_cast<std::uint32_t>(
      std::clamp<std::size_t>(kMostVotes / (places.size() * forests.size()), std::min(kFewestVoters, most_voters), most_voters));
  const std::size_t num_pairs = num_voters * static_cast<std::size_t>(num_trees);
  leaves_.resize(num_pairs * forests.size());
  for (std::size_t i = 0; i < forests.size(); ++i) {
    find_leaves(context, query.image, forests[i], Span<const SampledPixel>(voters_.data(), num_voters),
                Span<std::uint32_t>(leaves_.data() + i * num_pairs, num_pairs));
  }
  places_.assign(context, Span<const LeafModesView>(places));
  shares_.resize(forests.size() * places.size());
  const CountVotes body{num_trees,      static_cast<std::uint32_t>(forests.front().num_leaves),
                        num_voters,     voter_colours_.data(),
                        leaves_.data(), static_cast<std::uint32_t>(places.size()),
                        places_.data(), shares_.data()};
  dispatch(context, [&](auto on) { VotingAlgorithms<typename decltype(on)::Executor>::count(context, body, shares_.size()); });
  const std::vector<float> shares = shares_.to_host(context);
  std::vector<PlaceVote> votes(shares.size());
  for (std::size_t i = 0; i < votes.size(); ++i)
    votes[i] = {i % places.size(), first_roll + static_cast<int>(i / places.size()), shares[i]};
  std::stable_sort(votes.begin(), votes.end(), [](const PlaceVote& a, const PlaceVote& b) { return a.share > b.share; });
  return votes;
}

}  // namespace foothold

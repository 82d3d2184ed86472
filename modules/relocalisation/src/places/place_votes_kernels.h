// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// The bodies of place_votes.h, for both devices.
#pragma once

#include "clustering/leaf_colours.h"
#include "features/feature_image_kernels.h"
#include "places/place_votes.h"
#include "pose/pool_kernels.h"

namespace foothold {

/// Chooses a voter, and looks up its colour.
struct ChooseVoter {
  SamplePoolPixel sample;
  FeatureImageView image;
  int downscale;
  const SampledPixel* voters;
  Rgb8* voter_colours;

  FOOTHOLD_HD void operator()(std::size_t i) const {
    sample(i);
    const SampledPixel& at = voters[i];
    const FeaturePixel& pixel =
        image.pixels[clamp_index(at.v / downscale, image.height) * image.width + clamp_index(at.u / downscale, image.width)];
    voter_colours[i] = {static_cast<std::uint8_t>(pixel.r()), static_cast<std::uint8_t>(pixel.g()), static_cast<std::uint8_t>(pixel.b())};
  }
};

/// One team per place and roll adds up how close its leaves' colours are to their voters'. The colours of a place's leaves fit into a
/// cache, and no access waits for another.
struct CountVotes {
  int num_trees;
  std::uint32_t num_leaves;
  std::uint32_t num_voters;
  const Rgb8* voter_colours;
  const std::uint32_t* leaves;
  std::uint32_t num_places;
  const LeafModesView* places;
  float* shares;

  template <class Team>
  FOOTHOLD_HD void operator()(const Team& team, std::size_t index) const {
    const auto item = static_cast<std::uint32_t>(index);
    const LeafColours* const colours = places[item % num_places].colours;
    const std::uint32_t num_pairs = num_voters * static_cast<std::uint32_t>(num_trees);
    const std::uint32_t* const reached = leaves + std::size_t{item / num_places} * num_pairs;
    std::uint32_t num_reached = 0;
    std::uint32_t sum = 0;
    for (auto i = static_cast<std::uint32_t>(team.lane()); i < num_pairs; i += static_cast<std::uint32_t>(team.size())) {
      if (reached[i] >= num_leaves) continue;
      ++num_reached;
      sum += closeness(colours[reached[i]], voter_colours[i % num_voters]);
    }
    float sums[2] = {static_cast<float>(num_reached), static_cast<float>(sum)};  // whole numbers below 2^24: exact in any order
    team.sum_all(sums);
    if (team.lane() == 0) shares[item] = sums[0] > 0.0F ? sums[1] / (sums[0] * static_cast<float>(kMostCloseness)) : 0.0F;
  }
};

template <class Executor>
struct VotingAlgorithms {
  static void choose(const Context& context, const ChooseVoter& body, std::size_t num_voters);
  static void count(const Context& context, const CountVotes& body, std::size_t num_items);
};

template <class Executor>
void VotingAlgorithms<Executor>::choose(const Context& context, const ChooseVoter& body, std::size_t num_voters) {
  Executor(context).for_each(num_voters, body);
}

template <class Executor>
void VotingAlgorithms<Executor>::count(const Context& context, const CountVotes& body, std::size_t num_items) {
  Executor(context).for_each_team(num_items, body);
}

}  // namespace foothold

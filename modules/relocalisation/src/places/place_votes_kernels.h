// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// The bodies of place_votes.h, for both devices.
#pragma once

#include "features/feature_image_kernels.h"
#include "places/place_votes.h"
#include "pose/hypothesis_kernels.h"
#include "pose/pool_kernels.h"

namespace foothold {

/// Largest difference of a voter's colour to a mode's, in any channel [grey levels]. (T) docs/experiments/places.md
inline constexpr int kMaxVoteColourDifference = 20;

/// One team per place and roll counts the leaves that have a mode of their voter's colour.
struct CountVotes {
  FeatureImageView image;
  int downscale;
  int num_trees;
  std::uint32_t num_leaves;
  std::uint32_t num_voters;
  const SampledPixel* voters;
  const std::uint32_t* leaves;
  std::uint32_t num_places;
  const LeafModesView* places;
  float* shares;

  template <class Team>
  FOOTHOLD_HD void operator()(const Team& team, std::size_t index) const {
    const auto item = static_cast<std::uint32_t>(index);
    const LeafModesView& modes = places[item % num_places];
    const std::uint32_t num_pairs = num_voters * static_cast<std::uint32_t>(num_trees);
    const std::uint32_t* const reached = leaves + std::size_t{item / num_places} * num_pairs;
    float counts[2] = {};
    for (auto i = static_cast<std::uint32_t>(team.lane()); i < num_pairs; i += static_cast<std::uint32_t>(team.size())) {
      if (reached[i] >= num_leaves) continue;
      counts[0] += 1.0F;
      if (modes.num_modes[reached[i]] > 0 && has_mode_of_colour(modes, reached[i], voters[i % num_voters])) counts[1] += 1.0F;
    }
    team.sum_all(counts);
    if (team.lane() == 0) shares[item] = counts[0] > 0.0F ? counts[1] / counts[0] : 0.0F;
  }

 private:
  FOOTHOLD_HD bool has_mode_of_colour(const LeafModesView& modes, std::uint32_t leaf, const SampledPixel& at) const {
    const FeaturePixel& colour =
        image.pixels[clamp_index(at.v / downscale, image.height) * image.width + clamp_index(at.u / downscale, image.width)];
    const std::uint8_t rgb[3] = {static_cast<std::uint8_t>(colour.r()), static_cast<std::uint8_t>(colour.g()),
                                 static_cast<std::uint8_t>(colour.b())};
    for (std::uint32_t k = 0; k < modes.num_modes[leaf]; ++k) {
      if (colour_difference(rgb, modes.modes.at(leaf, static_cast<int>(k)).rgb) < kMaxVoteColourDifference) return true;
    }
    return false;
  }
};

template <class Executor>
struct VotingAlgorithms {
  static void sample(const Context& context, const SamplePoolPixel& body, std::size_t num_voters);
  static void count(const Context& context, const CountVotes& body, std::size_t num_items);
};

template <class Executor>
void VotingAlgorithms<Executor>::sample(const Context& context, const SamplePoolPixel& body, std::size_t num_voters) {
  Executor(context).for_each(num_voters, body);
}

template <class Executor>
void VotingAlgorithms<Executor>::count(const Context& context, const CountVotes& body, std::size_t num_items) {
  Executor(context).for_each_team(num_items, body);
}

}  // namespace foothold

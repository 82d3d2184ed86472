// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// The bodies of leaf_lookup.h, for both devices.
#pragma once

#include "features/leaf_lookup.h"

namespace foothold {

/// Walks a few pixels down one tree, side by side so that their memory accesses overlap; evaluates only the features on their way.
template <int kWidth>
struct FindLeaves {
  FeatureImageView image;
  int downscale;
  ForestView forest;
  Span<const SampledPixel> pixels;
  std::uint32_t* leaves;
  std::uint32_t groups_per_tree;

  FOOTHOLD_HD void operator()(std::size_t i) const {
    const auto item = static_cast<std::uint32_t>(i);
    const std::size_t tree = item / groups_per_tree;
    const std::size_t first = std::size_t{item % groups_per_tree} * static_cast<std::size_t>(kWidth);
    const int num = static_cast<int>(pixels.size() - first < static_cast<std::size_t>(kWidth) ? pixels.size() - first
                                                                                              : static_cast<std::size_t>(kWidth));
    Walks walks{};
    for (int w = 0; w < kWidth; ++w)
      start(w < num ? pixels[first + static_cast<std::size_t>(w)] : SampledPixel{}, forest.roots[tree], w, walks);
    while (step(walks)) {
    }
    for (int w = 0; w < num; ++w) {
      const std::int32_t leaf = walks.px_per_offset[w] > 0.0F ? ~forest.nodes[walks.node[w]].left_child : forest.num_leaves;
      leaves[tree * pixels.size() + first + static_cast<std::size_t>(w)] = static_cast<std::uint32_t>(leaf);
    }
  }

 private:
  /// Pixels on their way down; those without depth compare themselves with themselves.
  struct Walks {
    std::int32_t node[kWidth];
    std::int32_t u[kWidth];
    std::int32_t v[kWidth];
    float px_per_offset[kWidth];  ///< 0 without depth
  };

  FOOTHOLD_HD void start(const SampledPixel& pixel, std::int32_t root, int w, Walks& walks) const {
    const int u = clamp_index(pixel.u / downscale, image.width);
    const int v = clamp_index(pixel.v / downscale, image.height);
    const int depth_mm = image.pixels[v * image.width + u].depth_mm();
    const bool has_depth = pixel.depth_m > 0.0F && depth_mm > 0;
    walks.u[w] = u;
    walks.v[w] = v;
    walks.px_per_offset[w] = has_depth ? image.offset_scale_px_mm / static_cast<float>(depth_mm) : 0.0F;
    walks.node[w] = root;
  }

  /// Takes each pixel one node down. No branch asks whether one has arrived: it could not be foreseen. @return False if all have.
  FOOTHOLD_HD bool step(Walks& walks) const {
    ForestNode node[kWidth];
    std::int32_t all = -1;
    for (int w = 0; w < kWidth; ++w) {
      node[w] = forest.nodes[walks.node[w]];
      all &= node[w].left_child;
    }
    if (all < 0) return false;
    std::int32_t channel[kWidth];
    float offset_u[kWidth];
    float offset_v[kWidth];
    std::int32_t partner[kWidth];
    for (int w = 0; w < kWidth; ++w) {
      const ForestFeature& feature = forest.features[node[w].left_child < 0 ? 0 : node[w].feature];
      channel[w] = static_cast<std::int32_t>(feature.channel);
      offset_u[w] = feature.offset_u_px_m * walks.px_per_offset[w];
      offset_v[w] = feature.offset_v_px_m * walks.px_per_offset[w];
    }
    for (int w = 0; w < kWidth; ++w) partner[w] = partner_of(image, walks.u[w], walks.v[w], offset_u[w], offset_v[w]);
    for (int w = 0; w < kWidth; ++w) {
      const int own = image.pixels[walks.v[w] * image.width + walks.u[w]].channels[channel[w]];
      const int value = own - image.pixels[partner[w]].channels[channel[w]];
      walks.node[w] = node[w].left_child < 0 ? walks.node[w] : node[w].left_child + (value >= node[w].threshold ? 1 : 0);
    }
    return true;
  }
};

template <class Executor>
struct LeafLookupAlgorithms {
  static void find_leaves(const Context& context, const FeatureImage& image, const ForestView& forest, Span<const SampledPixel> pixels,
                          Span<std::uint32_t> leaves);
};

template <class Executor>
void LeafLookupAlgorithms<Executor>::find_leaves(const Context& context, const FeatureImage& image, const ForestView& forest,
                                                 Span<const SampledPixel> pixels, Span<std::uint32_t> leaves) {
  constexpr std::size_t kWidth = Executor::kVectorWidth;
  const std::size_t groups_per_tree = (pixels.size() + kWidth - 1) / kWidth;
  Executor(context).for_each(groups_per_tree * static_cast<std::size_t>(forest.num_trees),
                             FindLeaves<Executor::kVectorWidth>{image.view(), image.downscale(), forest, pixels, leaves.data(),
                                                                static_cast<std::uint32_t>(groups_per_tree)});
}

}  // namespace foothold

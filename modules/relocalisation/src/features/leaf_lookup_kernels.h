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
    int u[kWidth] = {};
    int v[kWidth] = {};
    float px_per_offset[kWidth] = {};
    ForestNode node[kWidth];
    for (int w = 0; w < num; ++w)
      start(pixels[first + static_cast<std::size_t>(w)], forest.roots[tree], u[w], v[w], px_per_offset[w], node[w]);
    bool any_branch = true;
    while (any_branch) {
      any_branch = false;
      for (int w = 0; w < num; ++w) {
        if (node[w].left_child < 0) continue;
        const int value = evaluate_feature(image, u[w], v[w], px_per_offset[w], forest.features[node[w].feature]);
        node[w] = forest.nodes[node[w].left_child + (value >= node[w].threshold ? 1 : 0)];
        any_branch = true;
      }
    }
    for (int w = 0; w < num; ++w) {
      leaves[tree * pixels.size() + first + static_cast<std::size_t>(w)] = static_cast<std::uint32_t>(~node[w].left_child);
    }
  }

 private:
  /// Puts a pixel at the root; one without depth at an imaginary leaf behind the last.
  FOOTHOLD_HD void start(const SampledPixel& pixel, std::int32_t root, int& u, int& v, float& px_per_offset, ForestNode& node) const {
    u = clamp_index(pixel.u / downscale, image.width);
    v = clamp_index(pixel.v / downscale, image.height);
    const int depth_mm = image.pixels[v * image.width + u].depth_mm();
    const bool has_depth = pixel.depth_m > 0.0F && depth_mm > 0;
    px_per_offset = has_depth ? image.offset_scale_px_mm / static_cast<float>(depth_mm) : 0.0F;
    node = has_depth ? forest.nodes[root] : ForestNode{~forest.num_leaves, 0, 0};
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

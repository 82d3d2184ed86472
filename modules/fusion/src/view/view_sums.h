// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// What ViewComparer shares with its kernels: pixels, sums, buffers.
#pragma once

#include <cstdint>
#include <vector>

#include "foothold/fusion/view_comparer.h"

namespace foothold {

/// Every so many pixels of the frame are compared, in both directions (T: train_quality_gate).
inline constexpr int kViewStridePx = 4;

/// One compared pixel: depth [m], and grey in [0, 1] or -1 where the colour camera did not see the point.
struct ViewPixel {
  float depth_m;
  float grey;
};

/// Differences of depth, in tolerances, from which on they count alike (T: train_quality_gate).
inline constexpr float kFarTolerances = 3.0F;

/// How a compared pixel relates to the rendering.
enum class PixelVerdict : std::int32_t {
  kUnmeasured,  ///< no depth
  kUnmapped,    ///< no rendered surface
  kAgrees,
  kInFront,     ///< in the map's free space
  kBehind,      ///< seen through the map's surface
  kFarInFront,  ///< the same, by more than noise and a pose that is a little off explain
  kFarBehind
};

/// One pixel compared with one rendering.
struct ComparedPixel {
  PixelVerdict verdict;
  float difference;  ///< of the depths, in tolerances, its magnitude; at most kFarTolerances
  float model_grey;  ///< in [0, 1], or -1 without colour
};

/// What is summed over the pixels of a tile. From kColours on: over agreeing pixels with colour on both sides.
enum ViewSum {
  kValid,
  kOverlap,
  kAgree,
  kFront,
  kBehind,
  kSolidFront,
  kSolidBehind,
  kDifference,
  kColours,
  kLive,
  kModel,
  kLive2,
  kModel2,
  kLiveModel,
  kNumViewSums
};

/// The moments of two variables over pixels, each about the mean of its part of them.
struct ViewMoments {
  double count;
  double live_variance;  ///< times count, as the other two
  double model_variance;
  double covariance;
};

/// What a comparison sums over a frame.
struct ViewTotals {
  double sums[kNumViewSums];
  ViewMoments texture;  ///< about the means of tiles
  double num_textured;  ///< tiles whose pattern can be compared
  double num_unlike;    ///< of these, tiles whose pattern is another
};
static_assert(sizeof(ViewTotals) == 8 * (kNumViewSums + 6), "copied from the device");

/// The moments of some sums about their own means; nothing without pixels.
template <class T>
FOOTHOLD_HD ViewMoments moments_of(const T* sums) {
  const double n = static_cast<double>(sums[kColours]);
  if (n < 1.0) return {};
  const double live = static_cast<double>(sums[kLive]);
  const double model = static_cast<double>(sums[kModel]);
  return {n, static_cast<double>(sums[kLive2]) - live * live / n, static_cast<double>(sums[kModel2]) - model * model / n,
          static_cast<double>(sums[kLiveModel]) - live * model / n};
}

struct ViewComparer::Scratch {
  explicit Scratch(const Memory& memory) : pixels(memory), pose(memory), compared(memory), tile_sums(memory), totals(memory) {}

  Intrinsics intrinsics;  ///< of the reduced image
  int width = 0;
  int height = 0;
  Array<ViewPixel> pixels;
  Array<SE3> pose;                ///< of a single comparison
  Array<ComparedPixel> compared;  ///< by comparison, then by pixel
  Array<float> tile_sums;         ///< by comparison, then by tile
  Array<ViewTotals> totals;
  std::vector<ViewTotals> host_totals;  ///< what queue_results() asked for
};

}  // namespace foothold

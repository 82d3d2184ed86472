// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// Sampling of a frame and its comparison with a rendering.
#pragma once

#include <cmath>

#include "rounding.h"
#include "view/view_sums.h"

namespace foothold {

/// Grey of a colour, in [0, 1], by the luma weights of ITU-R BT.601.
FOOTHOLD_HD inline float grey_of(const Rgb8& colour) {
  return (0.299F * static_cast<float>(colour.r) + 0.587F * static_cast<float>(colour.g) + 0.114F * static_cast<float>(colour.b)) *
         (1.0F / 255.0F);
}

struct SampleFrame {
  ImageView<const float> depth;
  ColourView colour;
  Intrinsics depth_intrinsics;
  Intrinsics colour_intrinsics;
  SE3 colour_from_depth;
  int width;
  DepthRange range;
  ViewPixel* pixels;

  FOOTHOLD_HD void operator()(std::size_t i) const {
    const int u = static_cast<int>(i) % width * kViewStridePx + kViewStridePx / 2;
    const int v = static_cast<int>(i) / width * kViewStridePx + kViewStridePx / 2;
    const float depth_m = depth(u, v);
    const bool usable = range.holds(depth_m);
    pixels[i] = {usable ? depth_m : 0.0F, usable ? grey_at(u, v, depth_m) : -1.0F};
  }

  FOOTHOLD_HD float grey_at(int u, int v, float depth_m) const {
    const Eigen::Vector3f point = colour_from_depth * depth_intrinsics.back_project(static_cast<float>(u), static_cast<float>(v), depth_m);
    if (point.z() <= 0.0F) return -1.0F;
    int cu = 0;
    int cv = 0;
    if (!nearest_pixel(colour_intrinsics.project(point), colour.width, colour.height, cu, cv)) return -1.0F;
    // The mean over the pixels that this one stands for: renderings are smooth, and single pixels would alias.
    float sum = 0.0F;
    int count = 0;
    for (int y = cv - kViewStridePx / 2; y <= cv + (kViewStridePx - 1) / 2; ++y) {
      for (int x = cu - kViewStridePx / 2; x <= cu + (kViewStridePx - 1) / 2; ++x) {
        if (x < 0 || y < 0 || x >= colour.width || y >= colour.height) continue;
        sum += grey_of(colour(x, y));
        ++count;
      }
    }
    return sum / static_cast<float>(count);
  }
};

/// Compares one tile of the frame with one rendering; its sums stay apart, so that texture can be told from shade.
struct CompareTile {
  static constexpr int kSide = 8;
  /// Depths that differ by at most kToleranceM + kToleranceGrowth * z^2 agree [m]: a Kinect's noise (T: train_quality_gate).
  static constexpr float kToleranceM = 0.02F;
  static constexpr float kToleranceGrowth = 0.003F;

  const ViewPixel* pixels;
  int width;
  int height;
  int num_columns;  ///< of tiles
  int num_tiles;
  Intrinsics intrinsics;
  const SurfacePixel* models;  ///< one rendering after another
  const Rgb8* colours;         ///< likewise; nullptr without colour
  Intrinsics model_intrinsics;
  int model_width;
  int model_height;
  const SE3* world_from_models;
  const SE3* world_from_cameras;
  float* tile_sums;

  template <class Team>
  FOOTHOLD_HD void operator()(const Team& team, std::size_t item) const {
    const int comparison = static_cast<int>(item) / num_tiles;
    const int tile = static_cast<int>(item) % num_tiles;
    const SE3 model_from_camera = world_from_models[comparison].inverse() * world_from_cameras[comparison];
    const int first_pixel = comparison * model_width * model_height;
    float sums[kNumViewSums] = {};
    const int u0 = tile % num_columns * kSide;
    const int v0 = tile / num_columns * kSide;
    for (int i = team.lane(); i < kSide * kSide; i += team.size()) {
      const int u = u0 + i % kSide;
      const int v = v0 + i / kSide;
      if (u < width && v < height) add(model_from_camera, first_pixel, u, v, sums);
    }
    team.sum_all(sums);
    for (int j = team.lane(); j < kNumViewSums; j += team.size()) tile_sums[item * kNumViewSums + static_cast<std::size_t>(j)] = sums[j];
  }

  FOOTHOLD_HD void add(const SE3& model_from_camera, int first_pixel, int live_u, int live_v, float (&sums)[kNumViewSums]) const {
    const ViewPixel live = pixels[live_v * width + live_u];
    if (live.depth_m <= 0.0F) return;
    sums[kValid] += 1.0F;
    const Eigen::Vector3f point =
        model_from_camera * intrinsics.back_project(static_cast<float>(live_u), static_cast<float>(live_v), live.depth_m);
    if (point.z() <= 0.0F) return;
    int u = 0;
    int v = 0;
    if (!nearest_pixel(model_intrinsics.project(point), model_width, model_height, u, v)) return;
    const int model_pixel = first_pixel + v * model_width + u;
    const float depth_m = models[model_pixel].depth_m;
    if (depth_m <= 0.0F) return;
    sums[kOverlap] += 1.0F;
    const float tolerance = kToleranceM + kToleranceGrowth * depth_m * depth_m;
    const float difference = (point.z() - depth_m) / tolerance;
    const float magnitude = std::abs(difference);
    sums[kDifference] += magnitude < 3.0F ? magnitude : 3.0F;
    if (magnitude > 1.0F) {
      sums[difference < 0.0F ? kFront : kBehind] += 1.0F;
      return;
    }
    sums[kAgree] += 1.0F;
    if (colours == nullptr || live.grey < 0.0F) return;
    const Rgb8 colour = colours[model_pixel];
    if ((colour.r | colour.g | colour.b) == 0) return;
    const float grey = grey_of(colour);
    sums[kColours] += 1.0F;
    sums[kLive] += live.grey;
    sums[kModel] += grey;
    sums[kLive2] += live.grey * live.grey;
    sums[kModel2] += grey * grey;
    sums[kLiveModel] += live.grey * grey;
  }
};

/// Adds up the tiles of one comparison. A lane takes every so many of them, in order.
struct TotalTiles {
  const float* tile_sums;
  int num_tiles;
  ViewTotals* totals;

  template <class Team>
  FOOTHOLD_HD void operator()(const Team& team, std::size_t comparison) const {
    constexpr int kNumMoments = 4;
    double sums[kNumViewSums + kNumMoments] = {};
    const float* const first = tile_sums + comparison * static_cast<std::size_t>(num_tiles) * kNumViewSums;
    for (int tile = team.lane(); tile < num_tiles; tile += team.size()) {
      const float* const of_tile = first + tile * kNumViewSums;
      for (int j = 0; j < kNumViewSums; ++j) sums[j] += static_cast<double>(of_tile[j]);
      add_moments(of_tile, sums + kNumViewSums);
    }
    team.sum_all(sums);
    if (team.lane() != 0) return;
    ViewTotals& result = totals[comparison];
    for (int j = 0; j < kNumViewSums; ++j) result.sums[j] = sums[j];
    result.texture = {sums[kNumViewSums], sums[kNumViewSums + 1], sums[kNumViewSums + 2], sums[kNumViewSums + 3]};
  }

  FOOTHOLD_HD static void add_moments(const float* of_tile, double* moments) {
    const ViewMoments own = moments_of(of_tile);
    moments[0] += own.count;
    moments[1] += own.live_variance;
    moments[2] += own.model_variance;
    moments[3] += own.covariance;
  }
};

/// The steps of ViewComparer that run on a device.
template <class Executor>
struct ViewAlgorithms {
  using Scratch = ViewComparer::Scratch;

  static void sample_frame(const Context& context, const Frame& frame, const DepthRange& range, Scratch& scratch);
  /// Leaves the totals of the frame's comparison with each rendering, each from a pose of its own, in `scratch`.
  static void compare(const Context& context, const SurfaceMap& models, const SE3* world_from_cameras, Scratch& scratch);
};

template <class Executor>
void ViewAlgorithms<Executor>::sample_frame(const Context& context, const Frame& frame, const DepthRange& range, Scratch& scratch) {
  const Executor exec(context);
  exec.for_each(scratch.pixels.size(),
                SampleFrame{frame.depth, frame.colour, frame.calibration.depth, frame.calibration.colour,
                            frame.calibration.depth_from_colour.inverse(), scratch.width, range, scratch.pixels.data()});
}

template <class Executor>
void ViewAlgorithms<Executor>::compare(const Context& context, const SurfaceMap& models, const SE3* world_from_cameras, Scratch& scratch) {
  const Executor exec(context);
  const int num_columns = (scratch.width + CompareTile::kSide - 1) / CompareTile::kSide;
  const int num_rows = (scratch.height + CompareTile::kSide - 1) / CompareTile::kSide;
  const int num_tiles = num_columns * num_rows;
  const std::size_t num_comparisons = models.num_renderings();
  const std::size_t num_teams = num_comparisons * static_cast<std::size_t>(num_tiles);
  scratch.tile_sums.resize(num_teams * kNumViewSums);
  scratch.totals.resize(num_comparisons);
  float* const tile_sums = scratch.tile_sums.data();
  exec.for_each_team(
      num_teams, CompareTile{scratch.pixels.data(), scratch.width, scratch.height, num_columns, num_tiles, scratch.intrinsics,
                             models.pixels.data(), models.colours.empty() ? nullptr : models.colours.data(), models.camera.intrinsics,
                             models.camera.width, models.camera.height, models.world_from_cameras.data(), world_from_cameras, tile_sums});
  exec.for_each_team(num_comparisons, TotalTiles{tile_sums, num_tiles, scratch.totals.data()});
}

}  // namespace foothold

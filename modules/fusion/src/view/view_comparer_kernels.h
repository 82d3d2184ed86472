// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// Sampling of a frame and its comparison with a rendering.
#pragma once

#include <cmath>

#include "grey_sampler.h"
#include "rounding.h"
#include "view/view_sums.h"

namespace foothold {

struct SampleFrame {
  ImageView<const float> depth;
  GreySampler greys;
  Intrinsics depth_intrinsics;
  int width;
  DepthRange range;
  ViewPixel* pixels;

  FOOTHOLD_HD void operator()(std::size_t i) const {
    const int u = static_cast<int>(i) % width * kViewStridePx + kViewStridePx / 2;
    const int v = static_cast<int>(i) / width * kViewStridePx + kViewStridePx / 2;
    const float depth_m = depth(u, v);
    const bool usable = range.holds(depth_m);
    pixels[i] = {usable ? depth_m : 0.0F,
                 usable ? greys.at(depth_intrinsics.back_project(static_cast<float>(u), static_cast<float>(v), depth_m)) : -1.0F};
  }
};

/// Side of the tiles in which pixels are compared [compared pixels] (T: train_quality_gate).
inline constexpr int kViewTileSide = 8;

/// How the compared pixels of a frame lie in tiles.
struct ViewTiles {
  int width;
  int height;

  FOOTHOLD_HD int num_columns() const { return (width + kViewTileSide - 1) / kViewTileSide; }
  FOOTHOLD_HD int count() const { return num_columns() * ((height + kViewTileSide - 1) / kViewTileSide); }

  /// Calls visit(u, v) for the pixels of a tile, a lane for every so many of them.
  template <class Team, class Visit>
  FOOTHOLD_HD void for_each_pixel(const Team& team, int tile, const Visit& visit) const {
    const int u0 = tile % num_columns() * kViewTileSide;
    const int v0 = tile / num_columns() * kViewTileSide;
    for (int i = team.lane(); i < kViewTileSide * kViewTileSide; i += team.size()) {
      const int u = u0 + i % kViewTileSide;
      const int v = v0 + i / kViewTileSide;
      if (u < width && v < height) visit(u, v);
    }
  }
};

/// Compares the pixels of one tile of the frame with one rendering.
struct CompareTile {
  /// Depths that differ by at most kToleranceM + kToleranceGrowth * z^2 agree [m]: a Kinect's noise (T: train_quality_gate).
  static constexpr float kToleranceM = 0.02F;
  static constexpr float kToleranceGrowth = 0.003F;

  const ViewPixel* pixels;
  ViewTiles tiles;
  Intrinsics intrinsics;
  const SurfacePixel* models;  ///< one rendering after another
  const Rgb8* colours;         ///< likewise; nullptr without colour
  Intrinsics model_intrinsics;
  int model_width;
  int model_height;
  const SE3* world_from_models;
  const SE3* world_from_cameras;
  ComparedPixel* compared;

  template <class Team>
  FOOTHOLD_HD void operator()(const Team& team, std::size_t item) const {
    const int comparison = static_cast<int>(item) / tiles.count();
    const SE3 model_from_camera = world_from_models[comparison].inverse() * world_from_cameras[comparison];
    ComparedPixel* const of_comparison = compared + comparison * tiles.width * tiles.height;
    tiles.for_each_pixel(team, static_cast<int>(item) % tiles.count(), [&](int u, int v) {
      of_comparison[v * tiles.width + u] = compare(model_from_camera, comparison * model_width * model_height, u, v);
    });
  }

  FOOTHOLD_HD ComparedPixel compare(const SE3& model_from_camera, int first_pixel, int live_u, int live_v) const {
    const ViewPixel live = pixels[live_v * tiles.width + live_u];
    if (live.depth_m <= 0.0F) return {PixelVerdict::kUnmeasured, 0.0F, -1.0F};
    const ComparedPixel unmapped{PixelVerdict::kUnmapped, 0.0F, -1.0F};
    const Eigen::Vector3f point =
        model_from_camera * intrinsics.back_project(static_cast<float>(live_u), static_cast<float>(live_v), live.depth_m);
    if (point.z() <= 0.0F) return unmapped;
    int u = 0;
    int v = 0;
    if (!nearest_pixel(model_intrinsics.project(point), model_width, model_height, u, v)) return unmapped;
    const int model_pixel = first_pixel + v * model_width + u;
    const float depth_m = models[model_pixel].depth_m;
    if (depth_m <= 0.0F) return unmapped;
    const float difference = (point.z() - depth_m) / (kToleranceM + kToleranceGrowth * depth_m * depth_m);
    const float magnitude = std::abs(difference);
    if (magnitude >= kFarTolerances)
      return {difference < 0.0F ? PixelVerdict::kFarInFront : PixelVerdict::kFarBehind, kFarTolerances, -1.0F};
    if (magnitude > 1.0F) return {difference < 0.0F ? PixelVerdict::kInFront : PixelVerdict::kBehind, magnitude, -1.0F};
    float grey = -1.0F;
    if (colours != nullptr && live.grey >= 0.0F) {
      const Rgb8 colour = colours[model_pixel];
      if ((colour.r | colour.g | colour.b) != 0) grey = grey_of(colour);
    }
    return {PixelVerdict::kAgrees, magnitude, grey};
  }
};

/// Sums up one tile of one comparison; its sums stay apart, so that texture can be told from shade.
struct SumTile {
  const ViewPixel* pixels;
  const ComparedPixel* compared;
  ViewTiles tiles;
  float* tile_sums;

  template <class Team>
  FOOTHOLD_HD void operator()(const Team& team, std::size_t item) const {
    const ComparedPixel* const of_comparison = compared + static_cast<int>(item) / tiles.count() * tiles.width * tiles.height;
    float sums[kNumViewSums] = {};
    tiles.for_each_pixel(team, static_cast<int>(item) % tiles.count(), [&](int u, int v) { add(of_comparison, u, v, sums); });
    team.sum_all(sums);
    for (int j = team.lane(); j < kNumViewSums; j += team.size()) tile_sums[item * kNumViewSums + static_cast<std::size_t>(j)] = sums[j];
  }

 private:
  /// Of the nine pixels around one, that must say the same for it to be part of something solid, rather than of an edge or noise (T).
  static constexpr int kSolid = 7;

  FOOTHOLD_HD void add(const ComparedPixel* of_comparison, int u, int v, float (&sums)[kNumViewSums]) const {
    const ComparedPixel& pixel = of_comparison[v * tiles.width + u];
    if (pixel.verdict == PixelVerdict::kUnmeasured) return;
    sums[kValid] += 1.0F;
    if (pixel.verdict == PixelVerdict::kUnmapped) return;
    sums[kOverlap] += 1.0F;
    sums[kDifference] += pixel.difference;
    if (pixel.verdict != PixelVerdict::kAgrees) {
      const bool in_front = pixel.verdict == PixelVerdict::kInFront || pixel.verdict == PixelVerdict::kFarInFront;
      const bool is_far = pixel.verdict == PixelVerdict::kFarInFront || pixel.verdict == PixelVerdict::kFarBehind;
      sums[in_front ? kFront : kBehind] += 1.0F;
      if (is_far && is_solid(of_comparison, pixel.verdict, u, v)) sums[in_front ? kSolidFront : kSolidBehind] += 1.0F;
      return;
    }
    sums[kAgree] += 1.0F;
    if (pixel.model_grey < 0.0F) return;
    const float live = pixels[v * tiles.width + u].grey;
    const float model = pixel.model_grey;
    sums[kColours] += 1.0F;
    sums[kLive] += live;
    sums[kModel] += model;
    sums[kLive2] += live * live;
    sums[kModel2] += model * model;
    sums[kLiveModel] += live * model;
  }

  FOOTHOLD_HD bool is_solid(const ComparedPixel* of_comparison, PixelVerdict verdict, int u, int v) const {
    if (u < 1 || v < 1 || u >= tiles.width - 1 || v >= tiles.height - 1) return false;
    int count = 0;
    for (int dv = -1; dv <= 1; ++dv) {
      for (int du = -1; du <= 1; ++du) count += of_comparison[(v + dv) * tiles.width + u + du].verdict == verdict ? 1 : 0;
    }
    return count >= kSolid;
  }
};

/// Adds up the tiles of one comparison. A lane takes every so many of them, in order.
struct TotalTiles {
  const float* tile_sums;
  int num_tiles;
  ViewTotals* totals;

  template <class Team>
  FOOTHOLD_HD void operator()(const Team& team, std::size_t comparison) const {
    double sums[kNumViewSums + kNumOfTexture] = {};
    const float* const first = tile_sums + comparison * static_cast<std::size_t>(num_tiles) * kNumViewSums;
    for (int tile = team.lane(); tile < num_tiles; tile += team.size()) {
      const float* const of_tile = first + tile * kNumViewSums;
      for (int j = 0; j < kNumViewSums; ++j) sums[j] += static_cast<double>(of_tile[j]);
      add_texture(of_tile, sums + kNumViewSums);
    }
    team.sum_all(sums);
    if (team.lane() != 0) return;
    ViewTotals& result = totals[comparison];
    for (int j = 0; j < kNumViewSums; ++j) result.sums[j] = sums[j];
    const double* const of_texture = sums + kNumViewSums;
    result.texture = {of_texture[0], of_texture[1], of_texture[2], of_texture[3]};
    result.num_textured = of_texture[4];
    result.num_unlike = of_texture[5];
  }

 private:
  static constexpr int kNumOfTexture = 6;         ///< four moments, two counts of tiles
  static constexpr double kFewestColours = 24.0;  ///< (T) agreeing pixels of a tile whose pattern can be compared
  static constexpr double kLeastContrast = 0.03;  ///< (T) standard deviation of grey values, of the frame or of the map, that is a pattern
  static constexpr double kLeastLikeness = 0.4;   ///< (T) correlation below which a pattern is another

  FOOTHOLD_HD static void add_texture(const float* of_tile, double* of_texture) {
    const ViewMoments own = moments_of(of_tile);
    of_texture[0] += own.count;
    of_texture[1] += own.live_variance;
    of_texture[2] += own.model_variance;
    of_texture[3] += own.covariance;
    const double least_variance = kLeastContrast * kLeastContrast * own.count;
    if (own.count < kFewestColours || (own.live_variance < least_variance && own.model_variance < least_variance)) return;
    of_texture[4] += 1.0;
    const double product = own.live_variance * own.model_variance;
    of_texture[5] += own.covariance > 0.0 && own.covariance * own.covariance > kLeastLikeness * kLeastLikeness * product ? 0.0 : 1.0;
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
                SampleFrame{frame.depth, GreySampler::of(frame), frame.calibration.depth, scratch.width, range, scratch.pixels.data()});
}

template <class Executor>
void ViewAlgorithms<Executor>::compare(const Context& context, const SurfaceMap& models, const SE3* world_from_cameras, Scratch& scratch) {
  const Executor exec(context);
  const ViewTiles tiles{scratch.width, scratch.height};
  const std::size_t num_comparisons = models.num_renderings();
  const std::size_t num_teams = num_comparisons * static_cast<std::size_t>(tiles.count());
  scratch.compared.resize(num_comparisons * scratch.pixels.size());
  scratch.tile_sums.resize(num_teams * kNumViewSums);
  scratch.totals.resize(num_comparisons);
  exec.for_each_team(num_teams,
                     CompareTile{scratch.pixels.data(), tiles, scratch.intrinsics, models.pixels.data(),
                                 models.colours.empty() ? nullptr : models.colours.data(), models.camera.intrinsics, models.camera.width,
                                 models.camera.height, models.world_from_cameras.data(), world_from_cameras, scratch.compared.data()});
  exec.for_each_team(num_teams, SumTile{scratch.pixels.data(), scratch.compared.data(), tiles, scratch.tile_sums.data()});
  exec.for_each_team(num_comparisons, TotalTiles{scratch.tile_sums.data(), tiles.count(), scratch.totals.data()});
}

}  // namespace foothold

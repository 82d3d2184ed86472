// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// Alignment of a depth image with a rendered surface, for both devices.
#pragma once

#include <algorithm>
#include <cmath>

#include "icp/grey_kernels.h"
#include "icp/pyramid_kernels.h"
#include "icp/residual_kernels.h"
#include "icp/solve_kernels.h"

namespace foothold {

/// The steps of IcpTracker that run on a device.
template <class Executor>
struct IcpAlgorithms {
  using Scratch = IcpTracker::Scratch;

  /// Halves level `level - 1` into `level`, for every level up to the coarsest.
  static void build_pyramid(const Context& context, const IcpLevels& levels, const DepthRange& range, Scratch& scratch);
  /// The number of pixels at a level whose depth is in range.
  static std::uint32_t count_depth(const Context& context, int level, const DepthRange& range, Scratch& scratch);
  /// Makes a rendering of the frame's depth at a level.
  static void make_surface(const Context& context, int level, const DepthRange& range, const Scratch& scratch, SurfaceMap& surface);
  /// Runs all levels for every rendering of `models` at once, from as many guesses, and leaves states and poses in `scratch`.
  static void align_by_depth(const Context& context, const IcpLevels& levels, const DepthRange& range, const SurfaceMap& models,
                             const SE3* guesses, Scratch& scratch);
  /// The same by depth and greys.
  static void align_by_both(const Context& context, const IcpLevels& levels, const DepthRange& range, const SurfaceMap& models,
                            const SE3* guesses, Scratch& scratch);

 private:
  /// Samples the frame's greys at the finest level, and halves them for every level up to the coarsest.
  static void sample_greys(const Context& context, const IcpLevels& levels, const DepthRange& range, Scratch& scratch);
  /// Makes the grey image of each rendering.
  static void make_greys(const Context& context, const SurfaceMap& models, Scratch& scratch);
  template <IcpResiduals kResiduals>
  static void align(const Context& context, const IcpLevels& levels, const DepthRange& range, const SurfaceMap& models, const SE3* guesses,
                    Scratch& scratch);
  template <IcpResiduals kResiduals>
  static void run_level(const Executor& exec, int level, const SurfaceMap& models, const IcpStep& step, Scratch& scratch);
};

template <class Executor>
void IcpAlgorithms<Executor>::build_pyramid(const Context& context, const IcpLevels& levels, const DepthRange& range, Scratch& scratch) {
  const Executor exec(context);
  for (int l = 1; l <= levels.coarsest; ++l) {
    const DepthLevel& fine = scratch.levels[l - 1];
    const DepthLevel& coarse = scratch.levels[l];
    exec.for_each_team(static_cast<std::size_t>(coarse.depth.height),
                       HalveDepth{fine.depth, range, scratch.depths_m[static_cast<std::size_t>(l - 1)].data(), coarse.depth.width});
  }
}

template <class Executor>
void IcpAlgorithms<Executor>::sample_greys(const Context& context, const IcpLevels& levels, const DepthRange& range, Scratch& scratch) {
  const Executor exec(context);
  const DepthLevel& finest = scratch.levels[levels.finest];
  while (scratch.greys.size() < static_cast<std::size_t>(levels.coarsest - levels.finest + 1)) scratch.greys.emplace_back(context.memory());
  for (int l = levels.finest; l <= levels.coarsest; ++l)
    scratch.greys[static_cast<std::size_t>(l - levels.finest)].resize(scratch.levels[l].depth.size());
  scratch.sharp_greys.resize(finest.depth.size());
  exec.for_each(finest.depth.size(), SampleGrey{finest, range, GreySampler::of(scratch.frame), scratch.sharp_greys.data()});
  exec.for_each(finest.depth.size(),
                SmoothGrey{scratch.sharp_greys.data(), finest.depth.width, finest.depth.height, scratch.greys.front().data()});
  for (int l = levels.finest + 1; l <= levels.coarsest; ++l) {
    const auto i = static_cast<std::size_t>(l - levels.finest);
    const ImageView<const float>& coarse = scratch.levels[l].depth;
    exec.for_each(coarse.size(),
                  HalveGrey{scratch.greys[i - 1].data(), scratch.levels[l - 1].depth.width, coarse.width, scratch.greys[i].data()});
  }
}

template <class Executor>
void IcpAlgorithms<Executor>::make_greys(const Context& context, const SurfaceMap& models, Scratch& scratch) {
  const Executor exec(context);
  scratch.model_greys.resize(models.pixels.size());
  exec.for_each(models.pixels.size(), MakeGreyPixel{models.pixels.data(), models.colours.data(), models.camera.width, models.camera.height,
                                                    scratch.model_greys.data()});
}

template <class Executor>
std::uint32_t IcpAlgorithms<Executor>::count_depth(const Context& context, int level, const DepthRange& range, Scratch& scratch) {
  const Executor exec(context);
  const ImageView<const float>& depth = scratch.levels[level].depth;
  const auto num_rows = static_cast<std::size_t>(depth.height);
  scratch.row_counts.resize(num_rows);
  scratch.row_offsets.resize(num_rows + 1);
  exec.for_each(num_rows, CountRow{depth, range, scratch.row_counts.data()});
  exec.exclusive_scan(Span<const std::uint32_t>(scratch.row_counts), Span<std::uint32_t>(scratch.row_offsets));
  return scratch.row_offsets.read(context, num_rows);
}

template <class Executor>
void IcpAlgorithms<Executor>::make_surface(const Context& context, int level, const DepthRange& range, const Scratch& scratch,
                                           SurfaceMap& surface) {
  const Executor exec(context);
  exec.for_each(surface.pixels.size(), MakeSurfacePixel{scratch.levels[level], range, surface.pixels.data()});
}

template <class Executor>
template <IcpResiduals kResiduals>
void IcpAlgorithms<Executor>::run_level(const Executor& exec, int level, const SurfaceMap& models, const IcpStep& step, Scratch& scratch) {
  constexpr int kWidth = Executor::kVectorWidth;
  constexpr bool kWithGreys = kResiduals == IcpResiduals::kDepthAndGrey;
  using Sum = SumChunk<kWidth, kResiduals>;
  const std::size_t num_alignments = models.num_renderings();
  const ImageView<const float>& depth = scratch.levels[level].depth;
  const int num_groups = (depth.width + kWidth - 1) / kWidth * depth.height;
  const int num_chunks = (num_groups + Sum::kGroupsPerChunk - 1) / Sum::kGroupsPerChunk;
  const std::size_t num_teams = num_alignments * static_cast<std::size_t>(num_chunks);
  scratch.chunk_sums.resize(num_teams * Sum::kNumSums);
  float* const sums = scratch.chunk_sums.data();
  IcpState* const states = scratch.states.data();
  exec.for_each(num_alignments, BeginLevel{states});
  for (int i = 0; i < kStepsPerLevel; ++i) {
    exec.for_each_team(num_teams, Sum{step, num_chunks, states, sums});
    exec.template for_each_team<SolveScratch>(num_alignments, SolveStep{states, sums, num_chunks, kResiduals, i == 0 || kWithGreys});
    if constexpr (Executor::kDevice == Device::kCpu) {
      if (std::all_of(states, states + num_alignments, [](const IcpState& state) { return state.converged != 0; })) break;
    }
  }
}

template <class Executor>
template <IcpResiduals kResiduals>
void IcpAlgorithms<Executor>::align(const Context& context, const IcpLevels& levels, const DepthRange& range, const SurfaceMap& models,
                                    const SE3* guesses, Scratch& scratch) {
  const Executor exec(context);
  const std::size_t num_alignments = models.num_renderings();
  scratch.states.resize(num_alignments);
  exec.for_each(num_alignments, BeginIcp{models.world_from_cameras.data(), guesses, scratch.states.data()});
  for (int l = levels.coarsest; l >= levels.finest; --l) {
    const float t = levels.coarsest == levels.finest
                        ? 0.0F
                        : static_cast<float>(l - levels.finest) / static_cast<float>(levels.coarsest - levels.finest);
    const float outlier_m = kFinestOutlierM * std::pow(kCoarsestOutlierM / kFinestOutlierM, t);
    const RenderCamera& camera = models.camera;
    IcpStep step{
        scratch.levels[l], models.pixels.data(), camera.intrinsics, camera.width, camera.height, nullptr, nullptr, outlier_m, range};
    if constexpr (kResiduals == IcpResiduals::kDepthAndGrey) {
      step.live_greys = scratch.greys[static_cast<std::size_t>(l - levels.finest)].data();
      step.model_greys = scratch.model_greys.data();
    }
    run_level<kResiduals>(exec, l, models, step, scratch);
  }
  scratch.world_from_cameras.resize(num_alignments);
  exec.for_each(num_alignments, EndIcp{scratch.states.data(), scratch.world_from_cameras.data()});
}

template <class Executor>
void IcpAlgorithms<Executor>::align_by_depth(const Context& context, const IcpLevels& levels, const DepthRange& range,
                                             const SurfaceMap& models, const SE3* guesses, Scratch& scratch) {
  align<IcpResiduals::kDepth>(context, levels, range, models, guesses, scratch);
}

template <class Executor>
void IcpAlgorithms<Executor>::align_by_both(const Context& context, const IcpLevels& levels, const DepthRange& range,
                                            const SurfaceMap& models, const SE3* guesses, Scratch& scratch) {
  sample_greys(context, levels, range, scratch);
  make_greys(context, models, scratch);
  align<IcpResiduals::kDepthAndGrey>(context, levels, range, models, guesses, scratch);
}

}  // namespace foothold

// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// Alignment of a depth image with a rendered surface, for both devices.
#pragma once

#include <algorithm>
#include <cmath>

#include "icp/pyramid_kernels.h"
#include "icp/residual_kernels.h"
#include "icp/solve_kernels.h"

namespace foothold {

/// The steps of IcpTracker that run on a device.
template <class Executor>
struct IcpAlgorithms {
  using Scratch = IcpTracker::Scratch;

  /// Halves level `level - 1` into `level`, for every level up to the coarsest.
  static void build_pyramid(const Context& context, const IcpSettings& settings, Scratch& scratch);
  /// The number of pixels at the finest level whose depth is in range.
  static std::uint32_t count_depth(const Context& context, const IcpSettings& settings, Scratch& scratch);
  /// Runs all levels for every rendering of `models` at once, from as many guesses, and leaves states and poses in `scratch`.
  static void align(const Context& context, const IcpSettings& settings, const SurfaceMap& models, const SE3* guesses, Scratch& scratch);
};

template <class Executor>
void IcpAlgorithms<Executor>::build_pyramid(const Context& context, const IcpSettings& settings, Scratch& scratch) {
  const Executor exec(context);
  for (int l = 1; l <= settings.coarsest_level; ++l) {
    const DepthLevel& fine = scratch.levels[l - 1];
    const DepthLevel& coarse = scratch.levels[l];
    exec.for_each(coarse.depth.size(), HalveDepth{fine.depth, settings.min_depth_m, settings.max_depth_m,
                                                  scratch.depths_m[static_cast<std::size_t>(l - 1)].data(), coarse.depth.width});
  }
}

template <class Executor>
std::uint32_t IcpAlgorithms<Executor>::count_depth(const Context& context, const IcpSettings& settings, Scratch& scratch) {
  const Executor exec(context);
  const ImageView<const float>& depth = scratch.levels[settings.finest_level].depth;
  const auto num_rows = static_cast<std::size_t>(depth.height);
  scratch.row_counts.resize(num_rows);
  scratch.row_offsets.resize(num_rows + 1);
  exec.for_each(num_rows, CountRow{depth, settings.min_depth_m, settings.max_depth_m, scratch.row_counts.data()});
  exec.exclusive_scan(Span<const std::uint32_t>(scratch.row_counts), Span<std::uint32_t>(scratch.row_offsets));
  return scratch.row_offsets.read(context, num_rows);
}

template <class Executor>
void IcpAlgorithms<Executor>::align(const Context& context, const IcpSettings& settings, const SurfaceMap& models, const SE3* guesses,
                                    Scratch& scratch) {
  constexpr int kWidth = Executor::kVectorWidth;
  const Executor exec(context);
  const std::size_t num_alignments = models.num_renderings();
  scratch.states.resize(num_alignments);
  IcpState* const states = scratch.states.data();
  exec.for_each(num_alignments, BeginIcp{models.world_from_cameras.data(), guesses, states});
  for (int l = settings.coarsest_level; l >= settings.finest_level; --l) {
    const DepthLevel& live = scratch.levels[l];
    const float t =
        settings.coarsest_level == settings.finest_level
            ? 0.0F
            : static_cast<float>(l - settings.finest_level) / static_cast<float>(settings.coarsest_level - settings.finest_level);
    const float outlier_m = settings.finest_outlier_m * std::pow(settings.coarsest_outlier_m / settings.finest_outlier_m, t);
    const int num_steps =
        settings.finest_steps + static_cast<int>(std::lround(t * static_cast<float>(settings.coarsest_steps - settings.finest_steps)));
    const IcpStep step{live,      models.pixels.data(),  models.camera.intrinsics, models.camera.width,  models.camera.height,
                       outlier_m, settings.noise_growth, settings.outlier_growth,  settings.min_depth_m, settings.max_depth_m};
    const int num_groups = (live.depth.width + kWidth - 1) / kWidth * live.depth.height;
    const int num_chunks = (num_groups + SumChunk<kWidth>::kGroupsPerChunk - 1) / SumChunk<kWidth>::kGroupsPerChunk;
    const std::size_t num_teams = num_alignments * static_cast<std::size_t>(num_chunks);
    scratch.chunk_sums.resize(num_teams * kNumSums);
    float* const sums = scratch.chunk_sums.data();
    exec.for_each(num_alignments, BeginLevel{states});
    for (int i = 0; i < num_steps; ++i) {
      exec.for_each_team(num_teams, SumChunk<kWidth>{step, num_chunks, states, sums});
      const bool rotation_only = settings.rotation_first && l == settings.coarsest_level;
      exec.template for_each_team<SolveScratch>(num_alignments,
                                                SolveStep{states, sums, num_chunks, i == 0, rotation_only, settings.converged_step});
      if constexpr (Executor::kDevice == Device::kCpu) {
        if (std::all_of(states, states + num_alignments, [](const IcpState& state) { return state.converged != 0; })) break;
      }
    }
  }
  scratch.world_from_cameras.resize(num_alignments);
  exec.for_each(num_alignments, EndIcp{states, scratch.world_from_cameras.data()});
}

}  // namespace foothold

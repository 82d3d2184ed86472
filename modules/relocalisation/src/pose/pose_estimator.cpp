// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "pose/pose_estimator.h"

#include <algorithm>

#include "foothold/base/exec/dispatch.h"
#include "pose/pose_estimator_kernels.h"

namespace foothold {

namespace {

/// (T) In seven rendered rooms rolled by 30 to 90 deg and RedKitchen's halves, leaving out rolls with which none can be drawn loses no
/// answer; a quarter as many hypotheses lose 1 %.
constexpr int kNumScreeningPixels = 500;
constexpr int kNumScreeningHypotheses = 256;

}  // namespace

#ifdef FOOTHOLD_HAS_CUDA
extern template struct PoseAlgorithms<CudaExecutor>;
#endif

PoseEstimator::Buffers::Buffers(MemoryKind memory)
    : sampled(memory),
      leaves(memory),
      mode_counts(memory),
      first_modes(memory),
      has_modes(memory),
      slots(memory),
      pixels(memory),
      modes(memory),
      hypotheses(memory),
      energies(memory),
      counts(memory),
      order(memory),
      sort_buffer(memory),
      nearest(memory),
      surfaces(memory),
      alignment(memory, 1),
      offsets(memory),
      misfits(memory),
      remembered(memory),
      evidence(memory),
      candidates(memory) {}

PoseEstimator::PoseEstimator(const Context& context, const PoseEstimatorSettings& settings)
    : settings_(settings), buffers_(context.memory()) {
  const auto pool_size = static_cast<std::size_t>(settings.pool_size);
  const auto num_hypotheses = static_cast<std::size_t>(settings.num_hypotheses);
  buffers_.sampled.resize(pool_size);
  buffers_.mode_counts.resize(pool_size);
  buffers_.first_modes.resize(pool_size + 1);
  buffers_.has_modes.resize(pool_size);
  buffers_.slots.resize(pool_size + 1);
  buffers_.pixels.resize(pool_size);
  buffers_.hypotheses.resize(num_hypotheses);
  buffers_.energies.resize(num_hypotheses);
  buffers_.order.resize(num_hypotheses);
  buffers_.surfaces.resize(static_cast<std::size_t>(std::min(settings.alignment_samples, settings.pool_size)));
  constexpr std::size_t kLargestGroup = 16;
  const std::size_t refined = (static_cast<std::size_t>(settings.cull_survivors) + kLargestGroup - 1) / kLargestGroup * kLargestGroup;
  buffers_.nearest.resize(refined * pool_size);
  buffers_.candidates.resize(static_cast<std::size_t>(std::min(settings.num_candidates, settings.num_hypotheses)));
  const std::vector<float> not_aligned(buffers_.candidates.size(), 1.0F);
  buffers_.remembered.resize(static_cast<std::size_t>(std::max(settings.ranking_points, settings.projection_points)));
  buffers_.evidence.resize(num_hypotheses);
  buffers_.evidence.clear_to_zero();
  buffers_.misfits.assign(Span<const float>(not_aligned));
}

void PoseEstimator::prepare(const Context& context, const PoseQuery& query) {
  const ScopedStage stage(context, "relocalise/prepare");
  dispatch(context, [&](auto on) { PoseAlgorithms<typename decltype(on)::Executor>::prepare(context, query, settings_, buffers_); });
}

void PoseEstimator::make_room_for(const PoseQuery& query, const ForestView& forest) {
  const auto pool_size = static_cast<std::size_t>(settings_.pool_size);
  const auto num_trees = static_cast<std::size_t>(forest.num_trees);
  buffers_.leaves.resize(pool_size * num_trees);
  buffers_.offsets.resize(buffers_.surfaces.size() * num_trees);
  buffers_.modes.resize(pool_size * num_trees * static_cast<std::size_t>(query.leaf_modes.modes.max_blocks * kModeBlockSize));
}

std::vector<std::uint32_t> PoseEstimator::count_hypotheses(const Context& context, const PoseQuery& query,
                                                           const std::vector<ForestView>& forests) {
  if (forests.empty()) return {};
  const ScopedStage stage(context, "relocalise/screen");
  PoseEstimatorSettings few = settings_;
  few.pool_size = std::min(kNumScreeningPixels, settings_.pool_size);
  few.num_hypotheses = std::min(kNumScreeningHypotheses, settings_.num_hypotheses);
  buffers_.counts.resize(forests.size());
  dispatch(context, [&](auto on) {
    using Algorithms = PoseAlgorithms<typename decltype(on)::Executor>;
    for (std::size_t i = 0; i < forests.size(); ++i) {
      make_room_for(query, forests[i]);
      const PoseProblem problem{context, query, forests[i], few};
      Algorithms::fill_pool(problem, buffers_);
      Algorithms::draw_hypotheses(problem, buffers_);
      Algorithms::count_drawn(problem, buffers_, i);
    }
  });
  return buffers_.counts.to_host(context);
}

std::vector<PoseCandidate> PoseEstimator::estimate(const Context& context, const PoseQuery& query, const ForestView& forest) {
  make_room_for(query, forest);
  const PoseProblem problem{context, query, forest, settings_};
  dispatch(context, [&](auto on) {
    using Algorithms = PoseAlgorithms<typename decltype(on)::Executor>;
    {
      const ScopedStage stage(context, "relocalise/correspondences");
      Algorithms::fill_pool(problem, buffers_);
    }
    {
      const ScopedStage stage(context, "relocalise/hypotheses");
      Algorithms::draw_hypotheses(problem, buffers_);
    }
    {
      const ScopedStage stage(context, "relocalise/ransac");
      Algorithms::preempt(problem, buffers_);
    }
    if (settings_.ranking_points > 0) {
      const ScopedStage stage(context, "relocalise/rank");
      Algorithms::rank(problem, buffers_);
    }
    const ScopedStage stage(context, "relocalise/refine");
    Algorithms::finish(problem, buffers_);
  });
  std::vector<PoseCandidate> candidates = buffers_.candidates.to_host(context);
  candidates.erase(std::remove_if(candidates.begin(), candidates.end(), [](const PoseCandidate& c) { return c.valid == 0; }),
                   candidates.end());
  return candidates;
}

}  // namespace foothold

// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "pose/pose_estimator.h"

#include <algorithm>

#include "foothold/base/exec/dispatch.h"
#include "pose/pose_estimator_kernels.h"

namespace foothold {

#ifdef FOOTHOLD_HAS_CUDA
extern template struct PoseAlgorithms<CudaExecutor>;
#endif

PoseBuffers::PoseBuffers(const Memory& memory, const SearchPlan& plan)
    : pool(memory, plan.pool_size),
      hypotheses(memory, plan.num_hypotheses),
      assignments(memory, plan.cull_survivors, plan.pool_size),
      ranking(memory, plan.confronts_scene ? kRememberedPoints : 0, plan.num_hypotheses),
      alignment(memory, plan.confronts_scene ? std::min(kFirstSamples, plan.pool_size) : 0),
      candidates(memory, static_cast<std::size_t>(plan.num_candidates)) {}

PoseEstimator::PoseEstimator(const Context& context, const SearchPlan& plan) : plan_(plan), buffers_(context.memory(), plan) {}

void PoseEstimator::make_room_for(const PlaceView& place, const ForestView& forest) {
  buffers_.pool.make_room(forest.num_trees, place.leaf_modes.modes.max_blocks * kModeBlockSize);
  buffers_.alignment.near.resize(buffers_.alignment.surfaces.size() * static_cast<std::size_t>(forest.num_trees));
}

void PoseEstimator::prepare(const Context& context, const PoseQuery& query) {
  const ScopedStage stage(context, "relocalise/prepare");
  buffers_.ranking.drawn_from = nullptr;
  dispatch(context, [&](auto on) { PoseAlgorithms<typename decltype(on)::Executor>::prepare(context, query, plan_, buffers_); });
}

std::vector<PoseCandidate> PoseEstimator::estimate(const Context& context, const PoseQuery& query, const PlaceView& place,
                                                   const ForestView& forest) {
  make_room_for(place, forest);
  dispatch(context,
           [&](auto on) { PoseAlgorithms<typename decltype(on)::Executor>::estimate(context, query, place, forest, plan_, buffers_); });
  std::vector<PoseCandidate> candidates = buffers_.candidates.to_host(context);
  candidates.erase(std::remove_if(candidates.begin(), candidates.end(), [](const PoseCandidate& c) { return c.valid == 0; }),
                   candidates.end());
  return candidates;
}

}  // namespace foothold

// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// From leaves to poses: hypotheses, culls, pre-emptive RANSAC and refinement. Reference: [Cavallari2017] Sec. 2.2.3, Eq. 4; [Chum2003].
#pragma once

#include <cstdint>
#include <vector>

#include "foothold/base/array.h"
#include "foothold/base/context.h"
#include "pose/align.h"
#include "pose/candidates.h"
#include "pose/hypotheses.h"
#include "pose/pool.h"
#include "pose/pose_query.h"
#include "pose/rank.h"
#include "pose/refine.h"
#include "pose/search_plan.h"

namespace foothold {

/// What the stages of an estimate work on; each is described in its stage's header.
struct PoseBuffers {
  PoseBuffers(const Memory& memory, const SearchPlan& plan);

  CorrespondencePool pool;
  Hypotheses hypotheses;
  ModeAssignments assignments;
  Ranking ranking;
  Alignment alignment;
  Array<PoseCandidate> candidates;
};

/// Estimates the camera of a frame from the modes its pixels reach. The stages follow one another in pose_estimator_kernels.h.
///
/// Determinism: a function of the arguments and the plan's seed, whatever the number of threads.
/// Cost: O(hypotheses x samples x modes); buffers are kept, so that a second call allocates nothing.
class PoseEstimator {
 public:
  PoseEstimator(const Context& context, const SearchPlan& plan);

  /// Chooses the pixels that every estimate of this query uses, in whatever place and however the camera is rolled.
  void prepare(const Context& context, const PoseQuery& query);

  /// @param forest  turned to a roll of the camera.
  /// @return        Candidates in the place's frame, best first. Empty if no triple passed the geometric checks: a normal outcome, not an
  /// error.
  /// @pre prepare() was called last with the same query.
  std::vector<PoseCandidate> estimate(const Context& context, const PoseQuery& query, const PlaceView& place, const ForestView& forest);

  /// What the last call of estimate() left behind.
  const PoseBuffers& buffers() const { return buffers_; }

 private:
  void make_room_for(const PlaceView& place, const ForestView& forest);

  SearchPlan plan_;
  PoseBuffers buffers_;
};

}  // namespace foothold

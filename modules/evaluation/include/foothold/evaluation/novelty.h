// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// Recall against how far a view is from everything that was learnt.
#pragma once

#include <string>
#include <vector>

#include "foothold/base/span.h"
#include "foothold/evaluation/protocol.h"
#include "foothold/evaluation/statistics.h"

namespace foothold {

/// The tested frames whose true pose is about equally far from the nearest training pose.
struct NoveltyBin {
  /// Some training pose is within these limits of the tested one, and within none of the bins before; not used by the last bin.
  PoseThreshold limit;
  bool is_rest = false;  ///< the last bin: beyond every limit
  int num_frames = 0;    ///< tested frames in the bin
  int num_found = 0;     ///< within kFoundThreshold
  Interval recall_95;    ///< Wilson interval of num_found / num_frames

  /// Such as "5cm_5deg" or "rest".
  std::string key() const { return is_rest ? "rest" : limit.key(); }
};

/// The paper's limits: 5 cm/5 deg, 10/10, ... 50/50 [Cavallari2017] Sec. 4.3.
const std::vector<PoseThreshold>& novelty_limits();

/// The first of novelty_limits() within both of whose limits some training pose lies; novelty_limits().size() if none does.
std::size_t novelty_bin_of(const SE3& world_from_camera, Span<const SE3> trained_world_from_camera);

/// Sorts the tests of a run into novelty bins, the rest last.
std::vector<NoveltyBin> novelty_bins(const RunLog& log);

/// Adds up the same bins of several runs, as the paper aggregates its scenes. @pre All have the bins of novelty_bins(); at least one.
std::vector<NoveltyBin> merge_novelty_bins(const std::vector<std::vector<NoveltyBin>>& runs);

/// The area under recall against novelty up to the last limit, as a part of what perfect recall would have: the mean recall of the limited
/// bins that hold frames. The last bin has no limit and does not count. NaN if no bin holds a frame.
double novelty_area(const std::vector<NoveltyBin>& bins);

}  // namespace foothold

// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "foothold/evaluation/novelty.h"

#include <algorithm>
#include <limits>

#include "foothold/base/contract.h"

namespace foothold {

const std::vector<PoseThreshold>& novelty_limits() {
  static const std::vector<PoseThreshold> limits = [] {
    std::vector<PoseThreshold> result;
    for (int step = 1; step <= 10; ++step) result.push_back({0.05 * step, 5.0 * step});
    return result;
  }();
  return limits;
}

std::size_t novelty_bin_of(const SE3& world_from_camera, Span<const SE3> trained_world_from_camera) {
  const std::vector<PoseThreshold>& limits = novelty_limits();
  std::size_t bin = limits.size();
  for (const SE3& trained : trained_world_from_camera) {
    const PoseError error = pose_error(world_from_camera, trained);
    while (bin > 0 && limits[bin - 1].contains(error)) --bin;  // limits grow, so the first that holds is found from above
  }
  return bin;
}

std::vector<NoveltyBin> novelty_bins(const RunLog& log) {
  const std::vector<PoseThreshold>& limits = novelty_limits();
  std::vector<NoveltyBin> bins(limits.size() + 1);
  for (std::size_t i = 0; i < limits.size(); ++i) bins[i].limit = limits[i];
  bins.back().is_rest = true;
  for (const TestRecord& test : log.tests) {
    NoveltyBin& bin = bins[novelty_bin_of(test.world_from_camera_true, log.trained_world_from_camera)];
    ++bin.num_frames;
    bin.num_found += test.within(kFoundThreshold) ? 1 : 0;
  }
  for (NoveltyBin& bin : bins) bin.recall_95 = wilson_interval(bin.num_found, bin.num_frames);
  return bins;
}

std::vector<NoveltyBin> merge_novelty_bins(const std::vector<std::vector<NoveltyBin>>& runs) {
  FOOTHOLD_EXPECTS(!runs.empty());
  std::vector<NoveltyBin> sum = runs.front();
  for (std::size_t run = 1; run < runs.size(); ++run) {
    FOOTHOLD_EXPECTS(runs[run].size() == sum.size());
    for (std::size_t bin = 0; bin < sum.size(); ++bin) {
      sum[bin].num_frames += runs[run][bin].num_frames;
      sum[bin].num_found += runs[run][bin].num_found;
    }
  }
  for (NoveltyBin& bin : sum) bin.recall_95 = wilson_interval(bin.num_found, bin.num_frames);
  return sum;
}

double novelty_area(const std::vector<NoveltyBin>& bins) {
  double area = 0.0;
  int num_bins = 0;
  for (const NoveltyBin& bin : bins) {
    if (bin.is_rest || bin.num_frames == 0) continue;
    area += static_cast<double>(bin.num_found) / bin.num_frames;
    ++num_bins;
  }
  return num_bins == 0 ? std::numeric_limits<double>::quiet_NaN() : area / num_bins;
}

}  // namespace foothold

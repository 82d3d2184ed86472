// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "foothold/base/contract.h"
#include "foothold/evaluation/kidnap.h"
#include "foothold/evaluation/statistics.h"

namespace foothold {

KidnapOutcome judge_kidnap(Span<const PlayedFrame> played, Span<const std::optional<SE3>> reference) {
  FOOTHOLD_EXPECTS(played.size() == reference.size());
  KidnapOutcome outcome;
  double duration_ms = 0.0;
  for (std::size_t i = 0; i < played.size(); ++i) {
    const PlayedFrame& frame = played[i];
    duration_ms += frame.duration_ms;
    if (!reference[i].has_value()) continue;
    ++outcome.num_judged;
    const bool right =
        frame.world_from_camera.has_value() && kResumedThreshold.contains(pose_error(*frame.world_from_camera, *reference[i]));
    outcome.right_at_end = right;
    if (right && frame.believed && !outcome.recovered) {
      outcome.recovered = true;
      outcome.num_frames = static_cast<int>(i) + 1;
      outcome.duration_ms = duration_ms;
    }
    if (right || !frame.world_from_camera.has_value()) continue;
    ++outcome.num_wrong;
    if (frame.believed) ++outcome.num_wrong_believed;
    if (frame.fused) ++outcome.num_wrong_fused;
  }
  return outcome;
}

KidnapSummary summarise_kidnaps(const std::vector<KidnapOutcome>& outcomes) {
  KidnapSummary summary;
  std::vector<double> frames;
  std::vector<double> durations_ms;
  for (const KidnapOutcome& outcome : outcomes) {
    if (outcome.num_judged == 0) continue;
    ++summary.num_kidnaps;
    summary.num_right_at_end += outcome.right_at_end ? 1 : 0;
    summary.num_wrong += outcome.num_wrong;
    summary.num_wrong_believed += outcome.num_wrong_believed;
    summary.num_wrong_fused += outcome.num_wrong_fused;
    summary.num_kidnaps_with_wrong += outcome.num_wrong > 0 ? 1 : 0;
    summary.num_kidnaps_with_wrong_believed += outcome.num_wrong_believed > 0 ? 1 : 0;
    if (!outcome.recovered) continue;
    ++summary.num_recovered;
    frames.push_back(outcome.num_frames);
    durations_ms.push_back(outcome.duration_ms);
  }
  const Spread spread = spread_of(frames);
  summary.median_frames = spread.median;
  summary.p95_frames = spread.p95;
  summary.median_ms = spread_of(durations_ms).median;
  return summary;
}

}  // namespace foothold

// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// The numbers by which methods are compared, from what a protocol noted down.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "foothold/evaluation/protocol.h"
#include "foothold/evaluation/statistics.h"

namespace foothold {

/// How many of the tested frames keep a threshold.
struct Recall {
  PoseThreshold threshold;  ///< the limits of translation and rotation
  int num_found = 0;        ///< tested frames that keep the threshold
  double fraction = 0.0;    ///< of all tested frames, in [0, 1]
};

/// A stretch of consecutive tests.
struct RecallWindow {
  std::int64_t first_frame = 0;  ///< the index of the first tested frame
  int num_tested = 0;            ///< frames in the stretch
  double fraction = 0.0;         ///< within kFoundThreshold
};

/// Durations of one kind of call [ms].
struct CallReport {
  int num_calls = 0;                        ///< of all frames
  Spread wall_ms;                           ///< by the clock [ms]
  Spread cpu_ms;                            ///< of the calling thread
  std::map<std::string, Spread> stages_ms;  ///< of the stages within the calls, by name [ms]
};

/// One method on one protocol. Fractions are of all tested frames unless said otherwise; medians without a sample are NaN.
struct MethodReport {
  int num_tested = 0;          ///< frames that were tested
  int num_trained = 0;         ///< frames that were learnt
  int num_without_pose = 0;    ///< frames left out, for they have no true pose
  int num_without_depth = 0;   ///< frames without depth: tested, they count as not found; none was learnt
  int num_answered = 0;        ///< tests that got an estimate, whatever its confidence
  std::vector<Recall> recall;  ///< recall_ladder(), counted on the best estimate whatever its confidence
  Interval recall_95;          ///< Wilson interval of the recall within kFoundThreshold; frames are correlated, so it is too narrow
  std::optional<std::int64_t> first_success_frame;  ///< the first frame found within kFoundThreshold
  std::vector<RecallWindow> recall_per_100;         ///< consecutive windows of 100 tests; the last may be shorter
  double median_translation_m = 0.0;                ///< over the answered tests
  double median_rotation_deg = 0.0;                 ///< over the answered tests [deg]

  float acceptance_threshold = 0.0F;   ///< the method's own: the confidence from which it is to be believed
  int num_accepted = 0;                ///< confidence at or above acceptance_threshold
  double accepted_recall = 0.0;        ///< accepted and within kFoundThreshold
  int num_false_accepts = 0;           ///< accepted and beyond kWrongThreshold: what a user sees as a camera that jumps
  double false_confidence_rate = 0.0;  ///< num_false_accepts / num_accepted; 0 if none was accepted
  double confidence_roc_area =
      0.0;  ///< how well confidence tells answers within kWrongThreshold from those beyond; NaN unless there are both

  CallReport train;       ///< of Relocaliser::train()
  CallReport relocalise;  ///< of Relocaliser::relocalise()
  CallReport update;      ///< of Relocaliser::update()
  double state_mb = 0.0;  ///< held for the scene at the end [1e6 bytes]
};

/// Sums up what a run noted down.
MethodReport make_report(const RunLog& log);

}  // namespace foothold

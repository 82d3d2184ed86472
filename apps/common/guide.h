// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// What the one who holds the camera should do.
#pragma once

#include <cstdint>
#include <deque>
#include <string>
#include <vector>

#include "foothold/fusion/fusion_pipeline.h"

namespace foothold::apps {

/// Watches the last two seconds of a run. Counts frames, not time, so that equal runs are guided alike.
class Guide {
 public:
  /// @param is_fast  The run is as fast as options can make it.
  explicit Guide(bool is_fast) : is_fast_(is_fast) {}

  /// A scene begins. @param is_loaded  It was saved before, and knows places that this run has not seen.
  void begin_world(bool is_loaded);

  /// Takes note of what became of the newest frame.
  /// @param num_pairs    that the camera has sent so far.
  /// @param num_skipped  of these.
  void add(std::int64_t num_pairs, std::int64_t num_skipped, const FusionFrameResult& result);

  /// One frame of five, or more, was skipped: there is no time for a finer picture.
  bool is_short_of_time() const;
  /// The camera was lost before the map held enough to find it by, and was not found since: the scene should begin again.
  bool start_has_failed() const;
  /// In words, a line each; empty if nothing is amiss.
  std::vector<std::string> advice() const;

 private:
  /// What the camera has sent.
  struct Sent {
    std::int64_t num_pairs;
    std::int64_t num_skipped;
  };

  /// Of the frames of the last two seconds [0, 1]; 0 while they are too few to tell.
  double skipped_share() const;

  bool is_fast_;
  bool is_loaded_ = false;
  std::int64_t num_fused_ = 0;  // in this world
  int num_lost_ = 0;            // frames in a row
  std::deque<Sent> sent_;       // when each of the last frames was taken
};

}  // namespace foothold::apps

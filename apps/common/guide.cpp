// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "common/guide.h"

#include <cmath>

namespace foothold::apps {
namespace {

constexpr std::int64_t kWatchedPairs = 60;  ///< two seconds of most cameras
constexpr std::int64_t kFewestPairs = 20;   ///< from which a share can be told
constexpr double kShortOfTime = 0.2;        ///< share of skipped frames
constexpr std::int64_t kFewestFused = 20;   ///< frames of a map that a camera can be found by
constexpr int kPatientFrames = 15;          ///< lost frames after which a start has failed

}  // namespace

void Guide::begin_world(bool is_loaded) {
  is_loaded_ = is_loaded;
  num_fused_ = 0;
  num_lost_ = 0;
}

void Guide::add(std::int64_t num_pairs, std::int64_t num_skipped, const FusionFrameResult& result) {
  num_fused_ += result.fused ? 1 : 0;
  num_lost_ = result.state == RecoveryState::kLost ? num_lost_ + 1 : 0;
  sent_.push_back({num_pairs, num_skipped});
  while (sent_.size() > 2 && num_pairs - sent_[1].num_pairs >= kWatchedPairs) sent_.pop_front();
}

double Guide::skipped_share() const {
  if (sent_.empty()) return 0.0;
  const std::int64_t num_pairs = sent_.back().num_pairs - sent_.front().num_pairs;
  const std::int64_t num_skipped = sent_.back().num_skipped - sent_.front().num_skipped;
  return num_pairs < kFewestPairs ? 0.0 : static_cast<double>(num_skipped) / static_cast<double>(num_pairs);
}

bool Guide::is_short_of_time() const { return skipped_share() >= kShortOfTime; }

bool Guide::start_has_failed() const { return !is_loaded_ && num_fused_ < kFewestFused && num_lost_ >= kPatientFrames; }

std::vector<std::string> Guide::advice() const {
  std::vector<std::string> lines;
  if (num_lost_ > 0) lines.emplace_back("lost: point the camera at what was mapped");
  if (is_short_of_time()) {
    lines.push_back(std::to_string(std::lround(10.0 * skipped_share())) + " of 10 frames skipped: move slowly" +
                    (is_fast_ ? "" : ", or use --fast"));
  }
  return lines;
}

}  // namespace foothold::apps

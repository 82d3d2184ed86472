// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// What the one who holds the camera is told.
#include "common/guide.h"

#include "common/canvas.h"
#include "common/view_style.h"
#include "support/catch.h"

namespace foothold::apps {
namespace {

FusionFrameResult frame(RecoveryState state) {
  FusionFrameResult result;
  result.state = state;
  result.fused = state == RecoveryState::kTracking;
  return result;
}

/// A guide after frames of which every `num_pairs_each`-th pair of the camera was taken.
Guide guide_after(int num_frames, int num_pairs_each, bool is_fast = false) {
  Guide guide(is_fast);
  for (int i = 1; i <= num_frames; ++i) guide.add(i * num_pairs_each, i * (num_pairs_each - 1), frame(RecoveryState::kTracking));
  return guide;
}

}  // namespace

TEST_CASE("Guide: has no advice while all is well") {
  CHECK(guide_after(100, 1).advice().empty());
  CHECK_FALSE(guide_after(100, 1).is_short_of_time());
  CHECK(Guide(false).advice().empty());
}

TEST_CASE("Guide: tells how many frames are skipped, and what to do about it") {
  CHECK(guide_after(100, 10).advice() == std::vector<std::string>{"9 of 10 frames skipped: move slowly, or use --fast"});
  CHECK(guide_after(100, 10, true).advice() == std::vector<std::string>{"9 of 10 frames skipped: move slowly"});
  CHECK(guide_after(2, 10).advice().empty());  // too early to tell
}

TEST_CASE("Guide: what it says fits into the picture of the map") {
  Guide guide = guide_after(100, 10);
  guide.add(1010, 909, frame(RecoveryState::kLost));
  for (const std::string& line : guide.advice()) CHECK(Canvas::text_width(line, style::kBody) < 440.0);
  CHECK(guide.advice().size() == 2);
}

TEST_CASE("Guide: forgets what was skipped long ago") {
  Guide guide = guide_after(10, 10);
  CHECK(guide.is_short_of_time());
  for (int i = 1; i <= 61; ++i) guide.add(100 + i, 90, frame(RecoveryState::kTracking));
  CHECK_FALSE(guide.is_short_of_time());
}

TEST_CASE("Guide: helps to find a lost camera") {
  Guide guide = guide_after(100, 1);
  guide.add(101, 0, frame(RecoveryState::kLost));
  CHECK(guide.advice() == std::vector<std::string>{"lost: point the camera at what was mapped"});
  guide.add(102, 0, frame(RecoveryState::kSettling));
  CHECK(guide.advice().empty());
}

TEST_CASE("Guide: a start has failed if the camera is lost for long before there is a map, and a loaded map is one") {
  const auto has_failed = [](Guide guide, int num_lost) {
    for (int i = 0; i < num_lost; ++i) guide.add(1000, 0, frame(RecoveryState::kLost));
    return guide.start_has_failed();
  };
  CHECK(has_failed(guide_after(3, 1), 15));
  CHECK_FALSE(has_failed(guide_after(3, 1), 14));
  CHECK_FALSE(has_failed(guide_after(20, 1), 100));
  Guide guide = guide_after(30, 1);
  guide.begin_world(false);
  CHECK(has_failed(guide, 15));
  guide.begin_world(true);
  CHECK_FALSE(has_failed(guide, 15));
}

}  // namespace foothold::apps

// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "foothold/fusion/recovery_policy.h"

#include "foothold/base/error.h"
#include "support/catch.h"
#include "support/random_seed.h"

namespace foothold {
namespace {

using Outcome = RelocalisationOutcome;
using Quality = TrackingQuality;
using State = RecoveryState;

constexpr int kSettleFrames = 4;
constexpr int kMaxPoor = 5;

RecoveryPolicy make_policy() {
  RecoverySettings settings;
  settings.settle_frames = kSettleFrames;
  settings.max_poor_frames = kMaxPoor;
  return RecoveryPolicy(settings);
}

/// Reports a frame; the relocaliser says `outcome` if it is asked.
RecoveryDecision step(RecoveryPolicy& policy, Quality quality, Outcome outcome = Outcome::kNothing) {
  return policy.update(quality, policy.should_relocalise(quality) ? outcome : Outcome::kNotAsked);
}

RecoveryPolicy lost_policy() {
  RecoveryPolicy policy = make_policy();
  step(policy, Quality::kFailed);
  REQUIRE(policy.state() == State::kLost);
  return policy;
}

RecoveryPolicy recovered_policy() {
  RecoveryPolicy policy = lost_policy();
  step(policy, Quality::kFailed, Outcome::kElsewhere);
  REQUIRE(policy.state() == State::kSettling);
  return policy;
}

void require(const RecoveryDecision& decision, State state, PoseSource pose, bool learns) {
  REQUIRE(decision.state == state);
  REQUIRE(decision.pose == pose);
  REQUIRE(decision.fuse == learns);
  REQUIRE(decision.train == learns);
}

TEST_CASE("RecoveryPolicy: tracking, good: fuses and trains, and asks nobody") {
  RecoveryPolicy policy = make_policy();
  REQUIRE(policy.state() == State::kTracking);
  REQUIRE(policy.should_track());
  REQUIRE_FALSE(policy.should_relocalise(Quality::kGood));
  for (int i = 0; i < 100; ++i) require(step(policy, Quality::kGood), State::kTracking, PoseSource::kTracker, true);
}

TEST_CASE("RecoveryPolicy: tracking, poor: neither fuses nor trains, until enough good frames follow") {
  RecoveryPolicy policy = make_policy();
  REQUIRE_FALSE(policy.should_relocalise(Quality::kPoor));
  require(step(policy, Quality::kPoor), State::kSettling, PoseSource::kTracker, false);
  for (int i = 0; i < kSettleFramesAfterPoor; ++i) require(step(policy, Quality::kGood), State::kSettling, PoseSource::kTracker, false);
  require(step(policy, Quality::kGood), State::kTracking, PoseSource::kTracker, true);
}

TEST_CASE("RecoveryPolicy: any, failed: lost at once if nothing is found, and asks on every frame then") {
  for (RecoveryPolicy policy : {make_policy(), recovered_policy(), lost_policy()}) {
    REQUIRE(policy.should_relocalise(Quality::kFailed));
    for (int i = 0; i < 100; ++i) require(step(policy, Quality::kFailed), State::kLost, PoseSource::kNone, false);
    REQUIRE_FALSE(policy.should_track());
  }
}

TEST_CASE("RecoveryPolicy: any, failed: settles on what the relocaliser found") {
  for (RecoveryPolicy policy : {make_policy(), recovered_policy(), lost_policy()}) {
    for (const Outcome outcome : {Outcome::kElsewhere, Outcome::kConfirms}) {
      RecoveryPolicy copy = policy;
      require(step(copy, Quality::kFailed, outcome), State::kSettling, PoseSource::kRelocaliser, false);
      REQUIRE(copy.should_track());
    }
  }
}

TEST_CASE("RecoveryPolicy: settling, good: nothing is learnt for the whole hold, then everything") {
  RecoveryPolicy policy = recovered_policy();
  for (int i = 0; i < kSettleFrames; ++i) {
    REQUIRE(policy.should_relocalise(Quality::kGood) == (i % kConfirmInterval == kConfirmInterval - 1));
    require(step(policy, Quality::kGood, i % 2 == 0 ? Outcome::kNothing : Outcome::kConfirms), State::kSettling, PoseSource::kTracker,
            false);
  }
  require(step(policy, Quality::kGood), State::kTracking, PoseSource::kTracker, true);
}

TEST_CASE("RecoveryPolicy: settling on a recovered pose lasts until views from new places confirmed it") {
  RecoveryPolicy policy = recovered_policy();
  REQUIRE(policy.is_unconfirmed());
  const auto good = [&](bool is_new_view) {
    return policy.update(Quality::kGood, policy.should_relocalise(Quality::kGood) ? Outcome::kConfirms : Outcome::kNotAsked, is_new_view);
  };
  for (int i = 0; i < 10 * kSettleFrames; ++i) require(good(false), State::kSettling, PoseSource::kTracker, false);
  require(good(true), State::kSettling, PoseSource::kTracker, false);
  REQUIRE(policy.is_unconfirmed());
  require(good(true), State::kTracking, PoseSource::kTracker, true);

  step(policy, Quality::kPoor);  // a pose that was tracked needs no views
  REQUIRE_FALSE(policy.is_unconfirmed());
  for (int i = 0; i < kSettleFramesAfterPoor; ++i) require(good(false), State::kSettling, PoseSource::kTracker, false);
  require(good(false), State::kTracking, PoseSource::kTracker, true);
}

TEST_CASE("RecoveryPolicy: a recovered pose that nothing has confirmed is taken back after few poor frames") {
  RecoveryPolicy policy = recovered_policy();
  for (int i = 0; i < kMaxPoor / 5; ++i) require(step(policy, Quality::kPoor), State::kSettling, PoseSource::kTracker, false);
  require(step(policy, Quality::kPoor), State::kLost, PoseSource::kNone, false);
}

TEST_CASE("RecoveryPolicy: settling, poor: the good frames must follow one another, and too many poor ones in a row are a loss") {
  RecoveryPolicy policy = recovered_policy();
  for (int i = 0; i < kSettleFrames; ++i) step(policy, Quality::kGood);
  require(step(policy, Quality::kPoor), State::kSettling, PoseSource::kTracker, false);
  for (int i = 0; i < kSettleFrames; ++i) require(step(policy, Quality::kGood), State::kSettling, PoseSource::kTracker, false);
  require(step(policy, Quality::kGood), State::kTracking, PoseSource::kTracker, true);

  for (int i = 0; i < kMaxPoor; ++i) require(step(policy, Quality::kPoor), State::kSettling, PoseSource::kTracker, false);
  require(step(policy, Quality::kPoor), State::kLost, PoseSource::kNone, false);
}

TEST_CASE("RecoveryPolicy: settling, elsewhere: the relocaliser overrules good and poor tracking, and the hold begins anew") {
  for (const Quality quality : {Quality::kGood, Quality::kPoor}) {
    RecoveryPolicy policy = recovered_policy();
    while (!policy.should_relocalise(quality)) step(policy, Quality::kGood);
    require(step(policy, quality, Outcome::kElsewhere), State::kSettling, PoseSource::kRelocaliser, false);
    for (int i = 0; i < kSettleFrames; ++i) require(step(policy, Quality::kGood), State::kSettling, PoseSource::kTracker, false);
    require(step(policy, Quality::kGood), State::kTracking, PoseSource::kTracker, true);
  }
}

TEST_CASE("RecoveryPolicy: whatever happens, nothing is learnt while lost, settling or without a pose") {
  Random random = test::test_random();
  RecoveryPolicy policy = make_policy();
  for (int i = 0; i < 20000; ++i) {
    const Quality quality = policy.should_track() ? static_cast<Quality>(random.below(3)) : Quality::kFailed;
    const Outcome outcome = random.below(2) == 0 ? Outcome::kNothing : (random.below(2) == 0 ? Outcome::kElsewhere : Outcome::kConfirms);
    const RecoveryDecision decision = step(policy, quality, outcome);
    REQUIRE((decision.pose == PoseSource::kNone) == (decision.state == State::kLost));
    REQUIRE(decision.fuse == decision.train);
    if (decision.fuse) {
      REQUIRE(decision.state == State::kTracking);
      REQUIRE(quality == Quality::kGood);
      REQUIRE(decision.pose == PoseSource::kTracker);
    }
    if (decision.state == State::kTracking) REQUIRE(decision.fuse);
  }
}

TEST_CASE("RecoveryPolicy: reset() goes back to tracking") {
  RecoveryPolicy policy = lost_policy();
  policy.reset();
  REQUIRE(policy.state() == State::kTracking);
  require(step(policy, Quality::kGood), State::kTracking, PoseSource::kTracker, true);
}

TEST_CASE("RecoverySettings: defaults, and what is refused") {
  const RecoverySettings defaults;
  REQUIRE(defaults.settle_frames == 10);
  REQUIRE(defaults.max_poor_frames == 30);
  RecoverySettings wrong;
  wrong.max_poor_frames = 0;
  REQUIRE_THROWS_AS(RecoveryPolicy(wrong), InvalidSettings);
}

}  // namespace
}  // namespace foothold

// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "foothold/evaluation/kidnap.h"

#include <algorithm>
#include <cmath>

#include "foothold/base/error.h"
#include "support/catch.h"
#include "support/random_seed.h"

namespace foothold {
namespace {

using Catch::Matchers::Contains;

constexpr int kNumFrames = 1000;

KidnapOptions options_of(int num_removed, int num_teleports, int num_blackouts) {
  KidnapOptions options;
  options.num_removed = num_removed;
  options.num_teleports = num_teleports;
  options.num_blackouts = num_blackouts;
  options.seed = test::test_random().bits();
  return options;
}

SE3 at(float x_m) { return {Eigen::Matrix3f::Identity(), {x_m, 0.0F, 0.0F}}; }

PlayedFrame played(std::optional<float> x_m, bool believed, bool fused = false) {
  PlayedFrame frame;
  if (x_m.has_value()) frame.world_from_camera = at(*x_m);
  frame.believed = believed;
  frame.fused = fused;
  frame.duration_ms = 10.0;
  return frame;
}

KidnapOutcome judge(const std::vector<PlayedFrame>& frames) {
  return judge_kidnap(frames, std::vector<std::optional<SE3>>(frames.size(), at(0.0F)));
}

}  // namespace

TEST_CASE("plan_sequential_kidnaps: every step follows the last, or a kidnap says why not") {
  const KidnapOptions options = options_of(4, 8, 3);
  const KidnapPlan plan = plan_sequential_kidnaps(kNumFrames, options);
  REQUIRE(plan.kidnaps.size() == 4 + 2 * 8 + 3);
  int next = 0;
  std::size_t num_met = 0;
  for (const PlayStep& step : plan.steps) {
    if (step.kidnap >= 0) {
      CHECK(step.kidnap == static_cast<int>(num_met++));
      const Kidnap& kidnap = plan.kidnaps[static_cast<std::size_t>(step.kidnap)];
      CHECK(kidnap.from + kidnap.num_covered == next);
      CHECK_FALSE(step.covered);
      next = kidnap.to;
    }
    REQUIRE(step.frame == next);
    ++next;
  }
  CHECK(num_met == plan.kidnaps.size());
  CHECK(next == kNumFrames);
}

TEST_CASE("plan_sequential_kidnaps: kidnaps leave room to be judged") {
  const KidnapOptions options = options_of(3, 10, 2);
  const KidnapPlan plan = plan_sequential_kidnaps(kNumFrames, options);
  int since_last = options.num_judged;
  for (std::size_t i = 0; i < plan.steps.size(); ++i) {
    const PlayStep& step = plan.steps[i];
    if (step.kidnap >= 0) {
      CHECK(since_last >= options.num_judged);
      CHECK(static_cast<int>(plan.steps.size() - i) >= options.num_judged);
      since_last = 0;
    }
    since_last += step.covered ? 0 : 1;
  }
  CHECK(plan.steps[0].kidnap == -1);
  CHECK(std::count_if(plan.steps.begin(), plan.steps.end(), [](const PlayStep& step) { return step.covered; }) ==
        2 * options.blackout_length);
}

TEST_CASE("plan_sequential_kidnaps: without kidnaps the recording is played as it is") {
  const KidnapPlan plan = plan_sequential_kidnaps(7, {});
  CHECK(plan.kidnaps.empty());
  REQUIRE(plan.steps.size() == 7);
  CHECK(plan.steps.back().frame == 6);
}

TEST_CASE("plan_sequential_kidnaps: short recordings are kidnapped earlier and less far") {
  KidnapOptions options = options_of(1, 1, 0);
  options.removed_length = 6;
  options.num_judged = 8;
  const KidnapPlan plan = plan_sequential_kidnaps(48, options);
  CHECK(plan.kidnaps.size() == 3);
  for (const Kidnap& kidnap : plan.kidnaps) {
    if (kidnap.kind != KidnapKind::kReturn) CHECK(kidnap.from >= 12);
    if (kidnap.kind == KidnapKind::kTeleport) CHECK(kidnap.to + 12 + options.num_judged <= kidnap.from);
  }
}

TEST_CASE("plan_sequential_kidnaps: refuses what does not fit") {
  CHECK_THROWS_WITH(plan_sequential_kidnaps(kNumFrames, options_of(20, 0, 0)), Contains("20 kidnaps") && Contains("1000 frames"));
  CHECK_THROWS_AS(plan_sequential_kidnaps(10, options_of(1, 0, 0)), InvalidSettings);
}

TEST_CASE("plan_independent_kidnaps: teleports lead back into what was seen, removals forward") {
  const KidnapOptions options = options_of(20, 20, 20);
  const std::vector<Kidnap> kidnaps = plan_independent_kidnaps(kNumFrames, options);
  REQUIRE(kidnaps.size() == 60);
  for (const Kidnap& kidnap : kidnaps) {
    CHECK(kidnap.from >= options.num_first);
    CHECK(kidnap.to >= 0);
    CHECK(kidnap.to + options.num_judged <= kNumFrames);
    if (kidnap.kind == KidnapKind::kTeleport) {
      CHECK(kidnap.to + options.teleport_gap + options.num_judged <= kidnap.from);
    } else {
      CHECK(kidnap.to - kidnap.from == (kidnap.kind == KidnapKind::kRemoved ? options.removed_length : options.blackout_length));
    }
    const std::vector<PlayStep> steps = independent_steps(kidnap, kNumFrames, options);
    CHECK(static_cast<int>(steps.size()) == kidnap.num_covered + options.num_judged);
    CHECK(steps.back().frame == kidnap.to + options.num_judged - 1);
  }
  CHECK(std::is_sorted(kidnaps.begin(), kidnaps.end(), [](const Kidnap& a, const Kidnap& b) { return a.from < b.from; }));
}

TEST_CASE("plan_independent_kidnaps: a function of the seed") {
  KidnapOptions options = options_of(5, 5, 0);
  const auto places = [&] {
    std::vector<int> result;
    for (const Kidnap& kidnap : plan_independent_kidnaps(kNumFrames, options)) result.push_back(kidnap.from * kNumFrames + kidnap.to);
    return result;
  };
  const std::vector<int> first = places();
  CHECK(places() == first);
  ++options.seed;
  CHECK(places() != first);
}

TEST_CASE("plan_independent_kidnaps: refuses what does not fit") {
  CHECK_THROWS_WITH(plan_independent_kidnaps(80, options_of(1, 0, 0)), Contains("'removed'") && Contains("80 frames"));
  CHECK_THROWS_WITH(plan_independent_kidnaps(40, options_of(0, 1, 0)), Contains("'teleport'"));
}

TEST_CASE("KidnapOptions: names the field that is wrong") {
  KidnapOptions options;
  options.removed_length = 0;
  CHECK_THROWS_WITH(options.validate(), Contains("removed_length") && Contains("0"));
}

TEST_CASE("judge_kidnap: counts the frames and the time until a right, believed pose") {
  const KidnapOutcome outcome = judge({played({}, false), played(0.05F, false), played(0.05F, true), played(0.0F, true)});
  CHECK(outcome.recovered);
  CHECK(outcome.num_frames == 3);
  CHECK(outcome.duration_ms == Approx(30.0));
  CHECK(outcome.right_at_end);
  CHECK(outcome.num_wrong == 0);
}

TEST_CASE("judge_kidnap: wrong poses count whether believed, fused or neither") {
  const KidnapOutcome outcome = judge({played(1.0F, false), played(1.0F, true), played(1.0F, true, true), played({}, false)});
  CHECK_FALSE(outcome.recovered);
  CHECK_FALSE(outcome.right_at_end);
  CHECK(outcome.num_frames == 0);
  CHECK(outcome.num_wrong == 3);
  CHECK(outcome.num_wrong_believed == 2);
  CHECK(outcome.num_wrong_fused == 1);
}

TEST_CASE("judge_kidnap: a rotation of 20 degrees is wrong") {
  PlayedFrame frame = played(0.0F, true);
  frame.world_from_camera->rotation << std::cos(0.35F), -std::sin(0.35F), 0, std::sin(0.35F), std::cos(0.35F), 0, 0, 0, 1;
  CHECK(judge({frame}).num_wrong_believed == 1);
}

TEST_CASE("judge_kidnap: frames without a reference are not judged") {
  const KidnapOutcome outcome = judge_kidnap(std::vector<PlayedFrame>{played(1.0F, true), played(0.0F, true)},
                                             std::vector<std::optional<SE3>>{std::nullopt, at(0.0F)});
  CHECK(outcome.num_wrong == 0);
  CHECK(outcome.num_judged == 1);
  CHECK(outcome.num_frames == 2);
}

TEST_CASE("summarise_kidnaps: counts kidnaps and frames, and takes medians over the recovered") {
  KidnapOutcome good;
  good.num_judged = 30;
  good.recovered = true;
  good.right_at_end = true;
  good.num_frames = 1;
  good.duration_ms = 20.0;
  KidnapOutcome slow = good;
  slow.num_frames = 5;
  slow.num_wrong = 2;
  KidnapOutcome bad;
  bad.num_judged = 30;
  bad.num_wrong = 3;
  bad.num_wrong_believed = 2;
  bad.num_wrong_fused = 1;
  const KidnapSummary summary = summarise_kidnaps({good, slow, bad, KidnapOutcome()});  // the last could not be judged
  CHECK(summary.num_kidnaps == 3);
  CHECK(summary.num_recovered == 2);
  CHECK(summary.num_kidnaps_with_wrong == 2);
  CHECK(summary.num_kidnaps_with_wrong_believed == 1);
  CHECK(summary.num_wrong == 5);
  CHECK(summary.num_wrong_fused == 1);
  CHECK(summary.median_frames == Approx(3.0));
  CHECK(std::isnan(summarise_kidnaps({bad}).median_frames));
}

}  // namespace foothold

// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include <algorithm>
#include <limits>

#include "fakes.h"
#include "foothold/base/error.h"
#include "foothold/evaluation/tracking_loss.h"
#include "foothold/evaluation/train_test.h"
#include "support/catch.h"

namespace foothold {
namespace {

using Catch::Matchers::Contains;
using Calls = std::vector<std::string>;

TEST_CASE("run_tracking_loss: relocalises each frame after the first, then learns it") {
  test::LeakDetector relocaliser;
  const RunLog log = run_tracking_loss(relocaliser, test::make_input(10, 13), 0);
  REQUIRE(relocaliser.calls == Calls{"train 10", "relocalise 11", "train 11", "relocalise 12", "train 12"});
  REQUIRE(log.tests.size() == 2);
  REQUIRE(log.tests[1].frame_index == 12);
  REQUIRE(log.tests[1].num_trained == 2);
  REQUIRE(log.trained_world_from_camera.size() == 3);
}

TEST_CASE("run_tracking_loss: with a gap of N tests frame i + N by what was learnt up to i - 1") {
  test::LeakDetector relocaliser;
  run_tracking_loss(relocaliser, test::make_input(0, 5), 2);
  REQUIRE(relocaliser.calls == Calls{"train 0", "relocalise 3", "train 1", "relocalise 4", "train 2"});
}

TEST_CASE("run_tracking_loss: never leaks the frame that is tested") {
  for (const int gap : {0, 1, 7}) {
    test::LeakDetector relocaliser;
    const RunLog log = run_tracking_loss(relocaliser, test::make_input(0, 30), gap);
    REQUIRE(log.tests.size() == static_cast<std::size_t>(29 - gap));
    REQUIRE(std::none_of(log.tests.begin(), log.tests.end(), [](const TestRecord& test) { return test.within(kFoundThreshold); }));
    for (const TestRecord& test : log.tests) REQUIRE(test.frame_index - test.num_trained == gap);
  }
}

TEST_CASE("run_tracking_loss: needs gap + 2 frames") {
  test::LeakDetector relocaliser;
  REQUIRE_NOTHROW(run_tracking_loss(relocaliser, test::make_input(0, 5), 3));
  REQUIRE_THROWS_WITH(run_tracking_loss(relocaliser, test::make_input(0, 5), 4),
                      Contains("fake") && Contains("5 frames") && Contains("at least 6"));
  REQUIRE_THROWS_AS(run_tracking_loss(relocaliser, test::make_input(0, 0), 0), FileError);
  EvaluationInput of_unknown_length = test::make_input(0, 5);
  of_unknown_length.num_frames = 0;
  REQUIRE_THROWS_WITH(run_tracking_loss(relocaliser, of_unknown_length, 4), Contains("5 frames"));
}

TEST_CASE("run_train_test: learns all training inputs, settles, then only tests") {
  test::LeakDetector relocaliser;
  const RunLog log =
      run_train_test(relocaliser, {test::make_input(0, 2), test::make_input(7, 8)}, {test::make_input(3, 4), test::make_input(0, 2)}, 2);
  REQUIRE(relocaliser.calls == Calls{"train 0", "train 1", "train 7", "update", "update", "relocalise 3", "relocalise 0", "relocalise 1"});
  REQUIRE(log.tests[0].input_index == 0);
  REQUIRE(log.tests[2].input_index == 1);
  REQUIRE_FALSE(log.tests[0].within(kFoundThreshold));
  REQUIRE(log.tests[2].within(kFoundThreshold));
  REQUIRE(log.update.wall_ms.size() == 2);
}

TEST_CASE("run_train_test: an input without frames is an error that names it") {
  test::LeakDetector relocaliser;
  REQUIRE_THROWS_WITH(run_train_test(relocaliser, {test::make_input(0, 0, "training")}, {test::make_input(0, 1)}, 0), Contains("training"));
  REQUIRE_THROWS_WITH(run_train_test(relocaliser, {test::make_input(0, 1)}, {test::make_input(0, 0, "tested")}, 0), Contains("tested"));
}

TEST_CASE("protocols: a frame that cannot be used is an error that names the input and the frame") {
  test::LeakDetector relocaliser;
  std::vector<RgbdFrame> frames = {test::make_frame(4), test::make_frame(5)};
  frames[1].depth = Image<float>(5, 3, 1.0F);  // not the size of its colour image
  const EvaluationInput input = test::make_input(frames, "room");
  REQUIRE_THROWS_AS(run_tracking_loss(relocaliser, input, 0), FileError);
  REQUIRE_THROWS_WITH(run_tracking_loss(relocaliser, input, 0), Contains("room, frame 5") && Contains("5x3"));
  REQUIRE_THROWS_WITH(run_train_test(relocaliser, {input}, {input}, 0), Contains("room, frame 5"));
}

TEST_CASE(
    "run_tracking_loss: frames without a pose are left out, frames without depth are not found and teach nothing, and both are counted") {
  test::LeakDetector relocaliser;
  std::vector<RgbdFrame> frames;
  for (int i = 0; i < 6; ++i) frames.push_back(test::make_frame(i));
  frames[2].world_from_camera.reset();
  frames[4].depth =
      Image<float>(frames[4].depth.width(), frames[4].depth.height(), GENERATE(0.0F, std::numeric_limits<float>::quiet_NaN()));
  const RunLog log = run_tracking_loss(relocaliser, test::make_input(frames), 0);
  CHECK(relocaliser.calls == Calls{"train 0", "relocalise 1", "train 1", "relocalise 3", "train 3", "relocalise 5", "train 5"});
  CHECK(log.num_without_pose == 1);
  CHECK(log.num_without_depth == 1);
  REQUIRE(log.tests.size() == 4);
  CHECK(log.tests[2].frame_index == 4);
  CHECK_FALSE(log.tests[2].best.has_value());
}

TEST_CASE("run_train_test: counts what its inputs lack") {
  test::LeakDetector relocaliser;
  std::vector<RgbdFrame> frames = {test::make_frame(0), test::make_frame(1), test::make_frame(2)};
  frames[0].world_from_camera.reset();
  frames[1].depth = Image<float>(frames[1].depth.width(), frames[1].depth.height());
  const RunLog log = run_train_test(relocaliser, {test::make_input(frames)}, {test::make_input(frames)}, 0);
  CHECK(relocaliser.calls == Calls{"train 2", "relocalise 2"});
  CHECK(log.num_without_pose == 2);
  CHECK(log.num_without_depth == 2);
  CHECK(log.tests.size() == 2);
  frames.resize(1);
  REQUIRE_THROWS_WITH(run_train_test(relocaliser, {test::make_input(frames, "room")}, {}, 0), Contains("room") && Contains("a true pose"));
}

TEST_CASE("protocols: stages are summed per call and kept apart by kind of call") {
  Trace trace;
  ContextOptions context_options;
  context_options.trace = &trace;
  test::Oracle relocaliser{Context(context_options)};
  ProtocolOptions options;
  options.trace = &trace;
  const RunLog log = run_tracking_loss(relocaliser, test::make_input(0, 4), 0, options);
  REQUIRE(log.train.stages_ms.at("train/a") == std::vector<double>{3, 3, 3, 3});
  REQUIRE(log.relocalise.stages_ms.at("relocalise/b") == std::vector<double>{1, 2, 3});
  REQUIRE(log.train.stages_ms.size() == 1);
  REQUIRE(log.train.wall_ms.size() == 4);
  REQUIRE(log.relocalise.cpu_ms.size() == 3);
}

TEST_CASE("protocols: progress counts every frame once and ends at the total") {
  std::vector<Progress> seen;
  ProtocolOptions options;
  options.progress = [&](const Progress& progress) { seen.push_back(progress); };
  test::Oracle oracle;
  run_tracking_loss(oracle, test::make_input(0, 6), 2, options);
  REQUIRE(seen.size() == 6);
  REQUIRE(seen.back().num_done == 6);
  REQUIRE(seen.back().num_total == 6);
  REQUIRE(seen.back().num_tested == 3);
  REQUIRE(seen.back().num_found == 3);
  seen.clear();
  run_train_test(oracle, {test::make_input(0, 3)}, {test::make_input(3, 5)}, 1, options);
  REQUIRE(seen.size() == 5);
  REQUIRE(seen[2].num_tested == 0);
  REQUIRE(seen.back().num_done == seen.back().num_total);
}

}  // namespace
}  // namespace foothold

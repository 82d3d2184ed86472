// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "common/reconstruction_monitor.h"

#include "foothold/io/sequence.h"
#include "support/catch.h"

namespace foothold::apps {
namespace {

/// A room, a pipeline without a relocaliser, and a monitor that follows it.
struct Rig {
  Context context = Context(ContextOptions{});
  std::shared_ptr<Sequence> sequence = open_sequence("synthetic:kitchen?frames=4&width=160&height=120&noise=0", context);
  FusionPipeline pipeline{context, FusionSettings{}, nullptr};
  ReconstructionMonitor monitor{context};
  RgbdFrame frame;

  void play(int index, bool event = false) {
    frame = sequence->load(index);
    monitor.add(pipeline, pipeline.process(frame.view()), event);
  }
};

}  // namespace

TEST_CASE("ReconstructionMonitor: shows the frame, the map and where the camera went") {
  Rig rig;
  for (int i = 0; i < 3; ++i) rig.play(i);
  const ViewContents contents = rig.monitor.contents(rig.frame, rig.pipeline);
  CHECK(contents.state == ViewState::kTracking);
  CHECK(contents.colour.width() == 160);
  CHECK(contents.depth_m.height() == 120);
  CHECK(contents.model.width() * 3 == contents.model.height() * 4);
  CHECK(contents.model_is_current);
  CHECK(contents.history.size() == 3);
  CHECK(contents.map.trajectory.size() == 3);
  CHECK(contents.map.trajectory.back().joined);
  CHECK(contents.timings.front().name == "track");
  CHECK(contents.total_ms > 0.0);
  CHECK_FALSE(contents.relocalised);
}

TEST_CASE("ReconstructionMonitor: a lost camera stays where it was last seen") {
  Rig rig;
  rig.play(0);
  rig.play(1);
  for (int i = 0; i < 2; ++i) {
    RgbdFrame dark = rig.sequence->load(2);
    dark.depth = Image<float>(160, 120, 0.0F);
    rig.monitor.add(rig.pipeline, rig.pipeline.process(dark.view()), i == 0);
    rig.frame = dark;
  }
  const ViewContents contents = rig.monitor.contents(rig.frame, rig.pipeline);
  CHECK(contents.state == ViewState::kLost);
  CHECK(contents.state_note == "for 2 frames");
  CHECK_FALSE(contents.model_is_current);
  CHECK_FALSE(contents.model.empty());
  CHECK(contents.history[2].event);
  CHECK_FALSE(contents.history[3].event);
  CHECK(contents.map.trajectory.size() == 2);
  REQUIRE(contents.map.camera.has_value());
  CHECK_FALSE(contents.map.camera->is_current);
}

TEST_CASE("ReconstructionMonitor: copies go their own ways, and clearing forgets") {
  Rig rig;
  rig.play(0);
  ReconstructionMonitor copy = rig.monitor;
  rig.play(1);
  CHECK(copy.contents(rig.frame, rig.pipeline).history.size() == 1);
  CHECK(rig.monitor.contents(rig.frame, rig.pipeline).history.size() == 2);
  rig.monitor.clear();
  const ViewContents contents = rig.monitor.contents(rig.frame, rig.pipeline);
  CHECK(contents.state == ViewState::kWaiting);
  CHECK(contents.history.empty());
  CHECK(contents.map.trajectory.empty());
}

TEST_CASE("ReconstructionMonitor: coarse detail shows what tracking rendered") {
  Rig rig;
  ReconstructionMonitor coarse(rig.context, ModelDetail::kCoarse);
  rig.frame = rig.sequence->load(0);
  coarse.add(rig.pipeline, rig.pipeline.process(rig.frame.view()));
  CHECK(coarse.contents(rig.frame, rig.pipeline).model.width() == rig.pipeline.rendering().camera.width);
}

}  // namespace foothold::apps

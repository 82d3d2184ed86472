// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// Reconstructions that are saved, and go on in another session.
#include "common/reconstruction_session.h"

#include "foothold/synthetic/synthetic_sequence.h"
#include "io_fixtures.h"
#include "support/catch.h"
#include "support/random_seed.h"

namespace foothold::apps {
namespace {

using namespace test;
using Catch::Matchers::Contains;

constexpr float kFound_m = 0.05F;

Context two_threads() {
  ContextOptions options;
  options.num_threads = 2;
  return Context(options);
}

SessionSettings small_settings() {
  SessionSettings settings;
  settings.fusion.volume.voxel_size_m = 0.02F;
  settings.fusion.volume.truncation_m = 0.08F;
  settings.forest.reservoirs.capacity = 64;
  return settings;
}

Forest small_forest(std::uint64_t seed = 42) {
  RandomForestSettings settings;
  settings.depth = 9;
  settings.seed = seed;
  return make_random_forest(settings);
}

/// A walk through a small kitchen, rendered once.
const std::vector<RgbdFrame>& kitchen() {
  static const std::vector<RgbdFrame> frames = [] {
    const auto sequence = make_synthetic_sequence(parse_synthetic_spec("synthetic:kitchen?frames=60&width=320&height=240"), two_threads());
    std::vector<RgbdFrame> result;
    for (int i = 0; i < sequence->num_frames(); ++i) result.push_back(sequence->load(i));
    return result;
  }();
  return frames;
}

/// The true pose of a frame in the world of a session that began with the first.
SE3 true_pose(const RgbdFrame& frame) { return kitchen().front().world_from_camera->inverse() * *frame.world_from_camera; }

void walk(ReconstructionSession& session, int num_frames) {
  for (int i = 0; i < num_frames; ++i) {
    const FusionFrameResult result = session.process(kitchen()[static_cast<std::size_t>(i)]);
    INFO("frame " << i);
    REQUIRE(result.world_from_camera.has_value());
  }
}

std::string bytes_of(const ReconstructionSession& session) {
  std::ostringstream stream;
  session.pipeline().save(stream);
  return stream.str();
}

std::string refusal(ReconstructionSession& session, const std::string& path) {
  return error_of([&] { session.load(path); });
}

}  // namespace

TEST_CASE("ReconstructionSession: in a loaded scene the camera is found in the first frames, and the map goes on") {
  const TempFolder temp;
  {
    ReconstructionSession session(two_threads(), small_settings(), small_forest());
    walk(session, 60);
    session.save(temp / "kitchen.scene", {{"source", "a kitchen"}});
  }
  ReconstructionSession session(two_threads(), small_settings(), small_forest());
  const std::vector<SettingText> provenance = session.load(temp / "kitchen.scene");
  REQUIRE(provenance.size() == 4);
  CHECK(provenance.front().text == "a kitchen");
  CHECK(session.pipeline().state() == RecoveryState::kLost);
  CHECK(session.state_bytes() > 0);

  constexpr std::size_t kFirst = 30;
  FusionFrameResult result;
  for (std::size_t i = kFirst; i < kFirst + 3 && !result.world_from_camera.has_value(); ++i) {
    result = session.process(kitchen()[i]);
    if (result.world_from_camera.has_value()) {
      CHECK(translation_distance_m(*result.world_from_camera, true_pose(kitchen()[i])) < kFound_m);
    }
  }
  REQUIRE(result.world_from_camera.has_value());
  for (std::size_t i = kFirst + 3; i < kitchen().size(); ++i) result = session.process(kitchen()[i]);
  CHECK(result.state == RecoveryState::kTracking);
  REQUIRE(result.world_from_camera.has_value());
  CHECK(translation_distance_m(*result.world_from_camera, true_pose(kitchen().back())) < kFound_m);
}

TEST_CASE("ReconstructionSession: without the relocaliser a camera carried away stays lost, and with it, it is found") {
  SessionSettings settings = small_settings();
  settings.fusion.refiner.slide_reach_m = 0.0F;  // or the last pose tracked would get there by itself: the room is small
  ReconstructionSession session(two_threads(), settings, small_forest());
  walk(session, 60);
  session.set_relocalises(false);
  CHECK_FALSE(session.relocalises());
  session.force_loss();
  for (std::size_t i = 0; i < 4; ++i) CHECK_FALSE(session.process(kitchen()[i]).world_from_camera.has_value());
  session.set_relocalises(true);
  bool found = false;
  for (std::size_t i = 4; i < 8 && !found; ++i) found = session.process(kitchen()[i]).relocalised;
  CHECK(found);
}

TEST_CASE("ReconstructionSession: after a reset it begins anew") {
  ReconstructionSession session(two_threads(), small_settings(), small_forest());
  walk(session, 5);
  session.reset();
  CHECK(session.pipeline().volume().num_blocks() == 0);
  CHECK(session.pipeline().state() == RecoveryState::kTracking);
  const FusionFrameResult result = session.process(kitchen()[30]);
  REQUIRE(result.world_from_camera.has_value());
  CHECK(result.world_from_camera->translation.isZero());
}

TEST_CASE("ReconstructionSession: scenes made otherwise are refused with what to do, and nothing is lost") {
  const TempFolder temp;
  SessionSettings other = small_settings();
  other.fusion.volume.voxel_size_m = 0.025F;
  other.forest.reservoirs.capacity = 128;
  ReconstructionSession(two_threads(), other, small_forest()).save(temp / "settings.scene", {});
  ReconstructionSession(two_threads(), small_settings(), small_forest(7)).save(temp / "forest.scene", {});
  write_text(temp / "no.scene", "nothing of the kind");

  ReconstructionSession session(two_threads(), small_settings(), small_forest());
  walk(session, 5);
  const std::string before = bytes_of(session);
  CHECK_THAT(refusal(session, temp / "settings.scene"),
             Contains(temp / "settings.scene") && Contains("fusion.volume.voxel_size_m = 0.025 instead of 0.02") &&
                 Contains("give --set fusion.volume.voxel_size_m=0.025 --set forest.reservoirs.capacity=128"));
  CHECK_THAT(refusal(session, temp / "forest.scene"), Contains(temp / "forest.scene") && Contains("another forest"));
  CHECK_THAT(refusal(session, temp / "no.scene"), Contains("not a scene of Foothold"));
  CHECK_THAT(refusal(session, temp / "absent.scene"), Contains("No such file"));
  CHECK(bytes_of(session) == before);
  CHECK(session.pipeline().state() == RecoveryState::kTracking);
}

TEST_CASE("ReconstructionSession: damaged scenes are refused, and nothing is lost") {
  const TempFolder temp;
  ReconstructionSession session(two_threads(), small_settings(), small_forest());
  walk(session, 3);
  session.save(temp / "a.scene", {});
  walk(session, 1);
  const std::string before = bytes_of(session);
  const std::string good = read_text(temp / "a.scene");
  Random random = test_random();
  for (int i = 0; i < 12; ++i) {
    std::string bad = good;
    const std::size_t place = random.below(static_cast<std::uint32_t>(good.size()));
    if (i % 2 == 0) {
      bad.resize(place);
    } else {
      bad[place] = static_cast<char>(bad[place] ^ static_cast<char>(1U << random.below(8)));
    }
    write_text(temp / "a.scene", bad);
    INFO("byte " << place << " of " << good.size());
    CHECK_THAT(refusal(session, temp / "a.scene"), Contains(temp / "a.scene"));
    REQUIRE(bytes_of(session) == before);
  }
  write_text(temp / "a.scene", good);
  CHECK(refusal(session, temp / "a.scene") == "(nothing was thrown)");
}

}  // namespace foothold::apps

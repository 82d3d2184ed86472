// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// Scenes of several places: what is remembered where, and how a place is chosen.
#include <sstream>
#include <vector>

#include "relocalisation/scenes.h"
#include "support/catch.h"

namespace foothold {
namespace {

using test::office;

constexpr float kRoomDistanceM = 20.0F;

SE3 moved(const SE3& pose, float x_m) { return {pose.rotation, pose.translation + Eigen::Vector3f(x_m, 0.0F, 0.0F)}; }

/// Frames of a rendered room; rendered once each.
std::vector<RgbdFrame> room(const std::string& name) {
  const auto sequence = make_synthetic_sequence(parse_synthetic_spec("synthetic:" + name + "?frames=160&width=320&height=240"), Context());
  std::vector<RgbdFrame> frames;
  for (int i = 0; i < sequence->num_frames(); i += 8) frames.push_back(sequence->load(i));
  return frames;
}

void learn(ForestRelocaliser& relocaliser, const std::vector<RgbdFrame>& frames, float x_m) {
  for (const RgbdFrame& frame : frames) relocaliser.train(frame.view(), moved(*frame.world_from_camera, x_m));
  for (int i = 0; i < 30; ++i) relocaliser.update();
}

int num_found(ForestRelocaliser& relocaliser, const std::vector<RgbdFrame>& frames, float x_m) {
  int count = 0;
  for (const RgbdFrame& frame : frames) {
    const auto estimates = relocaliser.relocalise(frame.view());
    count += !estimates.empty() && translation_distance_m(estimates[0].world_from_camera, moved(*frame.world_from_camera, x_m)) < 0.05F &&
                     estimates[0].confidence >= relocaliser.acceptance_threshold()
                 ? 1
                 : 0;
  }
  return count;
}

TEST_CASE("places: a room is found as well when others were learnt after it, and their memories add up") {
  const std::vector<RgbdFrame> kitchen = room("kitchen");
  const std::vector<RgbdFrame> lounge = room("lounge");
  ForestRelocaliser relocaliser = test::untrained();
  learn(relocaliser, kitchen, 0.0F);
  const int found_alone = num_found(relocaliser, kitchen, 0.0F);
  const std::size_t bytes_alone = relocaliser.state_bytes();
  REQUIRE(found_alone >= static_cast<int>(kitchen.size()) - 1);
  learn(relocaliser, lounge, kRoomDistanceM);
  ForestRelocaliser lounge_alone = test::untrained();
  learn(lounge_alone, lounge, kRoomDistanceM);
  REQUIRE(num_found(relocaliser, kitchen, 0.0F) == found_alone);
  REQUIRE(num_found(relocaliser, lounge, kRoomDistanceM) == num_found(lounge_alone, lounge, kRoomDistanceM));
  constexpr double kTolerance = 0.05;  // places draw their random numbers from seeds of their own
  const auto expected = static_cast<double>(bytes_alone + lounge_alone.state_bytes());
  REQUIRE(static_cast<double>(relocaliser.state_bytes()) == Approx(expected).epsilon(kTolerance));
}

TEST_CASE("places: of two rooms that are alike none is believed, and both are proposed") {
  ForestRelocaliser relocaliser = test::untrained();
  for (const float x_m : {0.0F, kRoomDistanceM}) {
    for (std::size_t i = 0; i < office().size(); i += 2) relocaliser.train(office()[i].view(), moved(*office()[i].world_from_camera, x_m));
    for (int i = 0; i < 30; ++i) relocaliser.update();
  }
  int num_both = 0;
  for (std::size_t i = 1; i < office().size(); i += 6) {
    const auto estimates = relocaliser.relocalise(office()[i].view());
    REQUIRE(!estimates.empty());
    CHECK(estimates[0].confidence < relocaliser.acceptance_threshold());
    bool here = false;
    bool there = false;
    for (const PoseEstimate& estimate : estimates) {
      here = here || translation_distance_m(estimate.world_from_camera, *office()[i].world_from_camera) < 0.1F;
      there = there || translation_distance_m(estimate.world_from_camera, moved(*office()[i].world_from_camera, kRoomDistanceM)) < 0.1F;
    }
    num_both += here && there ? 1 : 0;
  }
  CHECK(num_both >= 4);  // of 7; the other room is not always tried to the end
}

TEST_CASE("places: a room that is alike counts although there was no time to try it") {
  ForestRelocaliserSettings settings = test::small_settings();
  settings.max_relocalise_ms = 1e-3F;  // one room is tried
  for (const int num_rooms : {1, 2}) {
    ForestRelocaliser relocaliser(test::context_of(1), test::small_forest(), settings);
    for (int room = 0; room < num_rooms; ++room) {
      const float x_m = static_cast<float>(room) * kRoomDistanceM;
      for (std::size_t i = 0; i < office().size(); i += 2)
        relocaliser.train(office()[i].view(), moved(*office()[i].world_from_camera, x_m));
      for (int i = 0; i < 30; ++i) relocaliser.update();
    }
    int num_believed = 0;
    for (std::size_t i = 1; i < office().size(); i += 6) {
      const auto estimates = relocaliser.relocalise(office()[i].view());
      REQUIRE(!estimates.empty());
      num_believed += estimates[0].confidence >= relocaliser.acceptance_threshold() ? 1 : 0;
    }
    CHECK((num_rooms == 1 ? num_believed >= 6 : num_believed == 0));  // of 7
  }
}

TEST_CASE("places: who stays learns nothing more and takes no more memory") {
  ForestRelocaliserSettings settings = test::small_settings();
  settings.reservoirs.examples_per_view = 32;  // reached within 300 frames
  ForestRelocaliser relocaliser(test::context_of(1), test::small_forest(), settings);
  test::train_on(relocaliser, office().size());
  for (int i = 0; i < 300; ++i) relocaliser.train(office()[0].view(), *office()[0].world_from_camera);
  for (int i = 0; i < 50; ++i) relocaliser.update();
  const std::size_t bytes = relocaliser.state_bytes();
  const std::string before = test::saved(relocaliser);
  for (int i = 0; i < 20; ++i) relocaliser.train(office()[0].view(), *office()[0].world_from_camera);
  REQUIRE(relocaliser.state_bytes() == bytes);
  REQUIRE(test::saved(relocaliser) == before);
}

TEST_CASE("places: a loaded scene is extended by another room") {
  const std::vector<RgbdFrame> kitchen = room("kitchen");
  ForestRelocaliser relocaliser = test::untrained();
  test::train_on(relocaliser, office().size());
  std::stringstream stream;
  relocaliser.save(stream);
  ForestRelocaliser loaded = test::untrained();
  loaded.load(stream);
  for (ForestRelocaliser* each : {&relocaliser, &loaded}) learn(*each, kitchen, kRoomDistanceM);
  REQUIRE(test::saved(loaded) == test::saved(relocaliser));
  REQUIRE(num_found(loaded, kitchen, kRoomDistanceM) >= static_cast<int>(kitchen.size()) - 1);
}

}  // namespace
}  // namespace foothold

// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// Whole reconstructions: that they are saved and go on elsewhere, and that copies go their own way.
#include "foothold/reconstruction/reconstruction.h"

#include <sstream>

#include "foothold/relocalisation/keyframe_relocaliser.h"
#include "reconstruction/small_kitchen.h"
#include "support/catch.h"
#include "support/error_message.h"
#include "support/logged_warnings.h"
#include "support/random_seed.h"
#include "support/temp_folder.h"

namespace foothold {
namespace {

using namespace test;
using Catch::Matchers::Contains;

constexpr float kFound_m = 0.05F;

std::string refusal(Reconstruction& reconstruction, const std::string& path) {
  return error_of([&] { reconstruction.load(path); });
}

}  // namespace

TEST_CASE("Reconstruction: in a loaded scene the camera is found in the first frames, and the map goes on") {
  const TempFolder temp;
  {
    Reconstruction reconstruction(two_threads(), small_settings(), small_forest());
    walk(reconstruction, 60);
    reconstruction.save(temp / "kitchen.scene", {{"source", "a kitchen"}});
  }
  Reconstruction reconstruction(two_threads(), small_settings(), small_forest());
  const std::vector<SettingText> provenance = reconstruction.load(temp / "kitchen.scene");
  REQUIRE(provenance.size() == 4);
  CHECK(provenance.front().text == "a kitchen");
  CHECK(reconstruction.pipeline().state() == RecoveryState::kLost);
  CHECK(reconstruction.relocaliser_bytes() > 0);
  CHECK(reconstruction.pipeline().volume().num_blocks() > 0);

  constexpr std::size_t kFirst = 30;
  FusionFrameResult result;
  for (std::size_t i = kFirst; i < kFirst + 3 && !result.world_from_camera.has_value(); ++i) {
    result = reconstruction.process(kitchen()[i].view());
    if (result.world_from_camera.has_value()) {
      CHECK(translation_distance_m(*result.world_from_camera, true_pose(kitchen()[i])) < kFound_m);
    }
  }
  REQUIRE(result.world_from_camera.has_value());
  for (std::size_t i = kFirst + 3; i < kitchen().size(); ++i) result = reconstruction.process(kitchen()[i].view());
  CHECK(result.state == RecoveryState::kTracking);
  REQUIRE(result.world_from_camera.has_value());
  CHECK(translation_distance_m(*result.world_from_camera, true_pose(kitchen().back())) < kFound_m);
}

TEST_CASE("Reconstruction: without the relocaliser a camera carried away stays lost, and with it, it is found") {
  ReconstructionSettings settings = small_settings();
  settings.fusion.refiner.slide_reach_m = 0.0F;  // or the last pose tracked would get there by itself: the room is small
  Reconstruction reconstruction(two_threads(), settings, small_forest());
  walk(reconstruction, 60);
  reconstruction.set_relocalises(false);
  CHECK_FALSE(reconstruction.relocalises());
  reconstruction.force_loss();
  for (std::size_t i = 0; i < 4; ++i) CHECK_FALSE(reconstruction.process(kitchen()[i].view()).world_from_camera.has_value());
  reconstruction.set_relocalises(true);
  bool found = false;
  for (std::size_t i = 4; i < 8 && !found; ++i) found = reconstruction.process(kitchen()[i].view()).relocalised;
  CHECK(found);
}

TEST_CASE("Reconstruction: after a reset it begins anew") {
  Reconstruction reconstruction(two_threads(), small_settings(), small_forest());
  walk(reconstruction, 5);
  reconstruction.reset();
  CHECK(reconstruction.pipeline().volume().num_blocks() == 0);
  CHECK(reconstruction.pipeline().state() == RecoveryState::kTracking);
  const FusionFrameResult result = reconstruction.process(kitchen()[30].view());
  REQUIRE(result.world_from_camera.has_value());
  CHECK(result.world_from_camera->translation.isZero());
}

TEST_CASE("Reconstruction: scenes made otherwise are refused with what to do, and nothing is lost") {
  const TempFolder temp;
  ReconstructionSettings other = small_settings();
  other.fusion.volume.voxel_size_m = 0.025F;
  other.forest.reservoirs.capacity = 128;
  Reconstruction(two_threads(), other, small_forest()).save(temp / "settings.scene", {});
  Reconstruction(two_threads(), small_settings(), small_forest(7)).save(temp / "forest.scene", {});
  write_text(temp / "no.scene", "nothing of the kind");

  Reconstruction reconstruction(two_threads(), small_settings(), small_forest());
  walk(reconstruction, 5);
  const std::string before = bytes_of(reconstruction);
  CHECK_THAT(refusal(reconstruction, temp / "settings.scene"), Contains(temp / "settings.scene") &&
                                                                   Contains("fusion.volume.voxel_size_m = 0.025 instead of 0.02") &&
                                                                   Contains("forest.reservoirs.capacity = 128 instead of 64"));
  CHECK_THAT(refusal(reconstruction, temp / "forest.scene"), Contains(temp / "forest.scene") && Contains("another forest"));
  CHECK_THAT(refusal(reconstruction, temp / "no.scene"), Contains("not a scene of Foothold"));
  CHECK_THAT(refusal(reconstruction, temp / "absent.scene"), Contains("No such file"));
  CHECK(bytes_of(reconstruction) == before);
  CHECK(reconstruction.pipeline().state() == RecoveryState::kTracking);
}

TEST_CASE("Reconstruction: one with the settings that a refused scene names can go on with it") {
  const TempFolder temp;
  ReconstructionSettings settings = small_settings();
  settings.fusion.volume.voxel_size_m = 0.025F;
  settings.forest.reservoirs.capacity = 128;
  Reconstruction(two_threads(), settings, small_forest()).save(temp / "a.scene");
  Reconstruction reconstruction(two_threads(), small_settings(), small_forest());
  settings = small_settings();
  try {
    reconstruction.load(temp / "a.scene");
    FAIL("nothing was thrown");
  } catch (const OtherSceneSettings& error) {
    REQUIRE(error.settings().size() == 2);
    for (const SettingText& setting : error.settings()) assign_setting(settings, setting.path, setting.text);
  }
  reconstruction = Reconstruction(two_threads(), settings, small_forest());
  CHECK_NOTHROW(reconstruction.load(temp / "a.scene"));
}

TEST_CASE("Reconstruction: streams hold what files do, and are named in messages") {
  Reconstruction reconstruction(two_threads(), small_settings(), small_forest());
  walk(reconstruction, 3);
  std::stringstream stream;
  reconstruction.save(stream, {{"source", "a kitchen"}});
  Reconstruction other(two_threads(), small_settings(), small_forest());
  CHECK(other.load(stream, "a stream").front().text == "a kitchen");
  CHECK(bytes_of(other) == bytes_of(reconstruction));
  CHECK(other.relocaliser_bytes() == reconstruction.relocaliser_bytes());
  std::istringstream damaged(stream.str().substr(0, stream.str().size() / 2));
  CHECK_THAT(error_of([&] { other.load(damaged, "a stream"); }), Contains("a stream") && Contains("ends early"));
}

TEST_CASE("Reconstruction: copies go on alike, and leave each other alone") {
  Reconstruction original(two_threads(), small_settings(), small_forest());
  walk(original, 10);
  const std::string before = bytes_of(original);
  const std::size_t relocaliser_bytes = original.relocaliser_bytes();
  Reconstruction copy(original);
  std::vector<FusionFrameResult> of_copy;
  for (std::size_t i = 10; i < 20; ++i) of_copy.push_back(copy.process(kitchen()[i].view()));
  CHECK(bytes_of(original) == before);
  CHECK(original.relocaliser_bytes() == relocaliser_bytes);
  for (std::size_t i = 10; i < 20; ++i) {
    const FusionFrameResult result = original.process(kitchen()[i].view());
    REQUIRE(result.world_from_camera.has_value());
    CHECK(result.world_from_camera->translation == of_copy[i - 10].world_from_camera->translation);
  }
  CHECK(bytes_of(original) == bytes_of(copy));
}

TEST_CASE("Reconstruction: with a relocaliser of another kind it is saved and goes on, too") {
  const FusionSettings settings = small_settings().fusion;
  const auto make = [&] { return Reconstruction(two_threads(), settings, KeyframeRelocaliser(two_threads())); };
  Reconstruction reconstruction = make();
  walk(reconstruction, 20);
  CHECK(reconstruction.relocalises());
  CHECK(reconstruction.relocaliser_bytes() > 0);
  std::stringstream stream;
  reconstruction.save(stream);
  Reconstruction other = make();
  other.load(stream, "ferns");
  CHECK(other.relocaliser_bytes() == reconstruction.relocaliser_bytes());
  CHECK(bytes_of(other) == bytes_of(reconstruction));
}

TEST_CASE("Reconstruction: without a relocaliser it maps, and refuses scenes of one with") {
  Reconstruction reconstruction(two_threads(), small_settings().fusion);
  walk(reconstruction, 3);
  CHECK_FALSE(reconstruction.relocalises());
  CHECK(reconstruction.relocaliser_bytes() == 0);
  std::stringstream stream;
  reconstruction.save(stream);
  Reconstruction(reconstruction).load(stream, "a stream");
  std::stringstream with_relocaliser;
  Reconstruction(two_threads(), small_settings(), small_forest()).save(with_relocaliser);
  CHECK_THAT(error_of([&] { reconstruction.load(with_relocaliser, "a stream"); }), Contains("got 2 parts, expected 1"));
}

TEST_CASE("Reconstruction: the first pose is the host's to choose") {
  Reconstruction reconstruction(two_threads(), small_settings(), small_forest());
  reconstruction.start_at(*kitchen().front().world_from_camera);
  const FusionFrameResult result = reconstruction.process(kitchen().front().view());
  REQUIRE(result.world_from_camera.has_value());
  CHECK(result.world_from_camera->translation == kitchen().front().world_from_camera->translation);
}

TEST_CASE("Reconstruction: warns once of a map that is full, and names the setting") {
  LoggedWarnings log;
  ReconstructionSettings settings = small_settings();
  settings.fusion.volume.max_blocks = 50;
  Reconstruction reconstruction(log.context(), settings, small_forest());
  const FusionFrameResult result = reconstruction.process(kitchen()[0].view());
  CHECK(result.num_blocks_refused > 0);
  REQUIRE(log.warnings.size() == 1);
  CHECK_THAT(log.warnings[0], Contains("fusion.volume.max_blocks = 50") && Contains(std::to_string(result.num_blocks_refused) + " more"));
  reconstruction.process(kitchen()[0].view());
  Reconstruction copy(reconstruction);
  copy.process(kitchen()[0].view());
  CHECK(log.warnings.size() == 1);
}

TEST_CASE("Reconstruction: warns once if most of the depth is out of range, and names the limits") {
  LoggedWarnings log;
  ReconstructionSettings settings = small_settings();
  settings.fusion.volume.max_depth_m = 1.0F;
  Reconstruction reconstruction(log.context(), settings, small_forest());
  const FusionFrameResult result = reconstruction.process(kitchen()[0].view());
  CHECK(result.out_of_range_fraction > 0.5F);
  reconstruction.process(kitchen()[1].view());
  REQUIRE(log.warnings.size() == 1);
  CHECK_THAT(log.warnings[0], Contains("% of the depth") && Contains("fusion.volume.max_depth_m = 1,"));
  Reconstruction in_range(log.context(), small_settings(), small_forest());
  CHECK(in_range.process(kitchen()[0].view()).out_of_range_fraction < 0.5F);
  CHECK(log.warnings.size() == 1);
}

TEST_CASE("Reconstruction: warns once if the camera nears the end of the map, and names the setting") {
  LoggedWarnings log;
  const ReconstructionSettings settings = small_settings();
  const float reach_m = settings.fusion.volume.reach_m();
  CHECK(reach_m == Approx(1048574.0 * 8.0 * 0.02));
  Reconstruction reconstruction(log.context(), settings, small_forest());
  SE3 near_end;
  near_end.translation.x() = -(reach_m - settings.fusion.volume.max_depth_m - 1.0F);
  reconstruction.start_at(near_end);
  reconstruction.process(kitchen()[0].view());
  CHECK(reconstruction.pipeline().volume().num_blocks() > 0);
  CHECK(log.warnings.empty());
  SE3 beyond;
  beyond.translation.z() = reach_m + 10.0F;
  reconstruction.reset();
  reconstruction.start_at(beyond);
  reconstruction.process(kitchen()[0].view());
  CHECK(reconstruction.pipeline().volume().num_blocks() == 0);  // the camera sees nothing that the map holds
  REQUIRE(log.warnings.size() == 1);
  CHECK_THAT(log.warnings[0],
             Contains("the camera is 167782 m from") && Contains("fusion.volume.voxel_size_m = 0.02") && Contains("ends at 167772 m"));
  reconstruction.process(kitchen()[1].view());
  CHECK(log.warnings.size() == 1);
  near_end.translation.x() = 1.5F - reach_m;  // nearer than max_depth_m
  reconstruction.reset();
  reconstruction.start_at(near_end);
  CHECK(log.warnings.size() == 2);
  reconstruction.process(kitchen()[0].view());
  CHECK(log.warnings.size() == 2);
}

TEST_CASE("ReconstructionSettings: those of the parts are validated") {
  ReconstructionSettings settings;
  CHECK_NOTHROW(settings.validate());
  settings.fusion.volume.voxel_size_m = 9.0F;
  CHECK_THAT(error_of<InvalidSettings>([&] { settings.validate(); }), Contains("voxel_size_m"));
  CHECK_THROWS_AS(Reconstruction(two_threads(), settings, small_forest()), InvalidSettings);
}

TEST_CASE("Reconstruction: damaged scenes are refused, and nothing is lost") {
  const TempFolder temp;
  Reconstruction reconstruction(two_threads(), small_settings(), small_forest());
  walk(reconstruction, 3);
  reconstruction.save(temp / "a.scene", {});
  walk(reconstruction, 1);
  const std::string before = bytes_of(reconstruction);
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
    CHECK_THAT(refusal(reconstruction, temp / "a.scene"), Contains(temp / "a.scene"));
    REQUIRE(bytes_of(reconstruction) == before);
  }
  write_text(temp / "a.scene", good);
  CHECK(refusal(reconstruction, temp / "a.scene") == "(nothing was thrown)");
}

}  // namespace foothold

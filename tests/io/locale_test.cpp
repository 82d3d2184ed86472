// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// Everything that writes and reads text, in a host that writes 1.234,5: C's locale, and C++'s.
#include <functional>
#include <map>

#include "foothold/evaluation/text_table.h"
#include "foothold/files/scene_file.h"
#include "foothold/io/mesh_file.h"
#include "foothold/io/sequence.h"
#include "foothold/io/seven_scenes_writer.h"
#include "foothold/io/trajectory.h"
#include "foothold/synthetic/synthetic_sequence.h"
#include "io_fixtures.h"
#include "support/catch.h"
#include "support/comma_locale.h"

namespace foothold {
namespace {

using namespace test;

/// Numbers that have a point and thousands to group.
std::vector<StampedPose> poses() {
  SE3 pose = *small_frame(3).world_from_camera;
  pose.translation.x() = 12345.678F;
  return {{1234567.125, pose}, {1234568.25, SE3{}}};
}

Mesh mesh() {
  Mesh mesh;
  for (int i = 0; i < 1500; ++i) mesh.vertices.emplace_back(0.5F * static_cast<float>(i), 1.25F, -1e-7F);
  mesh.triangles = {{0, 1, 1499}};
  return mesh;
}

/// Writes a file of every kind. @return Their texts by name.
std::map<std::string, std::string> write_all(const TempFolder& temp, const std::string& name) {
  std::filesystem::create_directory(temp / name);
  const auto path = [&](const std::string& file) { return temp / (name + "/" + file); };
  write_trajectory(path("trajectory.txt"), poses());
  write_ply(path("mesh.ply"), mesh());
  save_settings(path("settings.json"), SyntheticSequenceSettings{});
  save_scene(path("a.scene"), {scene_settings(SyntheticSequenceSettings{}), {{"frames", "12"}}}, {});
  write_small_recording(path("recording"), 2);
  std::map<std::string, std::string> texts;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(temp / name)) {
    if (entry.is_regular_file()) texts[std::filesystem::relative(entry.path(), temp / name).string()] = read_text(entry.path().string());
  }
  return texts;
}

}  // namespace

TEST_CASE("io: files are written and read alike in a locale of decimal commas and grouped thousands") {
  const TempFolder temp;
  const auto expected = write_all(temp, "points");
  const CommaLocale commas;
  if (!commas.reached_c()) WARN("C's functions heed no decimal comma here: package locales is missing");
  const auto written = write_all(temp, "commas");
  REQUIRE(written.size() == expected.size());
  for (const auto& [name, text] : expected) {
    INFO(name);
    REQUIRE(written.count(name) == 1);
    CHECK((written.at(name) == text));
  }

  const auto trajectory = read_trajectory(temp / "commas/trajectory.txt");
  REQUIRE(trajectory.size() == 2);
  CHECK(trajectory[0].timestamp_s == 1234567.125);
  CHECK(trajectory[0].world_from_camera.translation.x() == 12345.678F);
  CHECK(read_ply(temp / "commas/mesh.ply").vertices.size() == 1500);
  SyntheticSequenceSettings settings;
  load_settings(temp / "commas/settings.json", settings);
  CHECK(read_scene_description(temp / "commas/a.scene").settings.size() == describe_settings(settings).size());
  const RgbdFrame frame = open_sequence(temp / "commas/recording", Context())->load(1);
  CHECK(frame.calibration.depth.cy == 11.25F);
  CHECK(frame.timestamp_s == 100.04);
  CHECK(frame.world_from_camera->translation.isApprox(small_frame(1).world_from_camera->translation));
  CHECK(open_sequence("synthetic:office?frames=2&width=32&height=24&noise=1", Context())->num_frames() == 2);
  CHECK(format_number(1234.5, 1) == "1234.5");
}

}  // namespace foothold

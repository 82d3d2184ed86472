// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// Real recordings, where the machine has them; their licences keep them out of the repository.
#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <vector>

#include "foothold/base/trace.h"
#include "foothold/io/sequence.h"
#include "foothold/io/sequence_player.h"
#include "support/catch.h"

namespace foothold {
namespace {

namespace fs = std::filesystem;

/// Where the recordings are: FOOTHOLD_DATA, or shared/data beside the sources. Empty if the one asked for is missing.
std::string recording(const std::string& name) {
  const char* chosen = std::getenv("FOOTHOLD_DATA");
  const fs::path folder = (chosen != nullptr ? fs::path(chosen) : fs::path(FOOTHOLD_SOURCE_DIR) / ".." / "shared" / "data") / name;
  if (fs::exists(folder)) return folder.string();
  WARN("skipped: " << folder.string() << " is missing (set FOOTHOLD_DATA to the folder that holds " << name << ")");
  return {};
}

double median_depth_m(const RgbdFrame& frame) {
  std::vector<double> depths;
  std::copy_if(frame.depth.data(), frame.depth.data() + frame.depth.size(), std::back_inserter(depths), is_valid_depth);
  return quantile(depths, 0.5);
}

void check_frame(const RgbdFrame& frame) {
  CHECK(describe_frame_error(frame.view()).empty());
  CHECK(frame.depth.width() == 640);
  CHECK(frame.depth.height() == 480);
  CHECK(median_depth_m(frame) > 0.4);
  CHECK(median_depth_m(frame) < 8.0);
  REQUIRE(frame.world_from_camera.has_value());
  CHECK(is_rigid(*frame.world_from_camera, 1e-6F));
}

}  // namespace

TEST_CASE("open_sequence: reads the real 7-Scenes kitchen, whose colour is not registered", "[data]") {
  const std::string folder = recording("7scenes/redkitchen/seq-01");
  if (folder.empty()) return;
  const auto sequence = open_sequence(folder, Context());
  REQUIRE(sequence->num_frames() == 1000);
  CHECK(sequence->name() == "redkitchen/seq-01");
  const RgbdFrame frame = sequence->load(0);
  check_frame(frame);
  CHECK(frame.calibration.depth.fx == 585.0F);
  CHECK(frame.calibration.colour.fx == 525.0F);
  CHECK(frame.calibration.depth_from_colour.translation.x() == Approx(0.0255).margin(5e-4));

  const auto registered = open_sequence(folder + "@10:12", Context(), {true});
  REQUIRE(registered->num_frames() == 2);
  CHECK(registered->load(1).index == 11);
  CHECK(registered->load(1).calibration.colour.fx == 585.0F);
}

TEST_CASE("open_sequence: reads the real TUM teddy, whose colour is registered", "[data]") {
  const std::string folder = recording("tum-fr3-teddy-200");
  if (folder.empty()) return;
  const auto sequence = open_sequence(folder, Context());
  REQUIRE(sequence->num_frames() == 188);
  SequencePlayer player(sequence, {0, 1, 100});
  RgbdFrame frame;
  while (player.read(frame) == ReadStatus::kFrame) {
    check_frame(frame);
    CHECK(frame.calibration.colour.fx == frame.calibration.depth.fx);
    CHECK(frame.calibration.depth_from_colour.translation.isZero());
  }
  CHECK(frame.index == 100);
  CHECK(frame.timestamp_s > 1341841873.0);
}

}  // namespace foothold

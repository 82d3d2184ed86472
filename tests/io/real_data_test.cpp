// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// Real recordings, where the machine has them; their licences keep them out of the repository.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <vector>

#include "foothold/base/trace.h"
#include "foothold/frames/register_colour.h"
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

/// How much the colour image changes across the depth edges of a frame, if it is moved by (du, dv): the mean difference of grey levels
/// (sums of three channels) to both sides of where the nearer point of two neighbours whose depths differ by 15 cm is seen.
double change_across_edges(const RgbdFrame& frame, int du, int dv) {
  constexpr float kJump_m = 0.15F;
  const SE3 colour_from_depth = frame.calibration.depth_from_colour.inverse();
  const auto grey = [&](int u, int v) { return frame.colour(u, v).r + frame.colour(u, v).g + frame.colour(u, v).b; };
  double sum = 0.0;
  int count = 0;
  const auto add = [&](int u, int v, int step_u, int step_v) {
    const float a = frame.depth(u, v);
    const float b = frame.depth(u + step_u, v + step_v);
    if (!is_valid_depth(a) || !is_valid_depth(b) || std::abs(a - b) < kJump_m) return;
    const float half_u = 0.5F * static_cast<float>(step_u);
    const float half_v = 0.5F * static_cast<float>(step_v);
    const Eigen::Vector3f point =
        frame.calibration.depth.back_project(static_cast<float>(u) + half_u, static_cast<float>(v) + half_v, std::min(a, b));
    const Eigen::Vector2f pixel = frame.calibration.colour.project(colour_from_depth * point);
    const int x = static_cast<int>(std::lround(pixel.x())) + du;
    const int y = static_cast<int>(std::lround(pixel.y())) + dv;
    if (x < 1 || y < 1 || x > 638 || y > 478) return;
    sum += std::abs(grey(x + step_u, y + step_v) - grey(x - step_u, y - step_v));
    ++count;
  };
  for (int v = 0; v < 479; ++v) {
    for (int u = 0; u < 639; ++u) {
      add(u, v, 1, 0);
      add(u, v, 0, 1);
    }
  }
  return count > 0 ? sum / count : 0.0;
}

}  // namespace

TEST_CASE("open_sequence: reads the real 7-Scenes kitchen, and registers its colour", "[data]") {
  const std::string folder = recording("7scenes/redkitchen/seq-01");
  if (folder.empty()) return;
  SequenceOptions as_recorded;
  as_recorded.register_colour = false;
  const auto sequence = open_sequence(folder, Context(), as_recorded);
  REQUIRE(sequence->num_frames() == 1000);
  CHECK(sequence->name() == "redkitchen/seq-01");
  const RgbdFrame frame = sequence->load(0);
  check_frame(frame);
  CHECK(frame.calibration.depth.fx == 585.0F);
  CHECK(frame.calibration.colour.fx == 525.0F);
  CHECK(frame.calibration.depth_from_colour.translation.x() == Approx(0.0241).margin(5e-4));

  const auto registered = open_sequence(folder + "@10:12", Context());
  REQUIRE(registered->num_frames() == 2);
  CHECK(registered->load(1).index == 11);
  CHECK(is_registered(registered->load(1).calibration));
  CHECK(registered->load(1).calibration.colour.fx == 585.0F);
}

TEST_CASE("open_sequence: in the real 7-Scenes kitchen, edges of colour are where its calibration takes those of depth", "[data]") {
  const std::string folder = recording("7scenes/redkitchen/seq-01");
  if (folder.empty()) return;
  SequenceOptions as_recorded;
  as_recorded.register_colour = false;
  const auto sequence = open_sequence(folder, Context(), as_recorded);
  constexpr int kOff_px = 5;
  double there = 0.0;
  std::array<double, 4> beside{};
  for (int i = 0; i < 1000; i += 50) {
    const RgbdFrame frame = sequence->load(i);
    there += change_across_edges(frame, 0, 0);
    beside[0] += change_across_edges(frame, -kOff_px, 0);
    beside[1] += change_across_edges(frame, kOff_px, 0);
    beside[2] += change_across_edges(frame, 0, -kOff_px);
    beside[3] += change_across_edges(frame, 0, kOff_px);
  }
  for (const double change : beside) CHECK(there > 1.2 * change);
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

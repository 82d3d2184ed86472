// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "foothold/io/seven_scenes_writer.h"

#include <algorithm>

#include "foothold/frames/register_colour.h"
#include "foothold/io/image_file.h"
#include "foothold/io/recording.h"
#include "foothold/io/sequence.h"
#include "io_fixtures.h"
#include "support/catch.h"

namespace foothold {
namespace {

using namespace test;
using Catch::Matchers::Contains;
namespace fs = std::filesystem;

bool same_depth(const Image<float>& a, const Image<float>& b) {
  return a.width() == b.width() && a.height() == b.height() && std::equal(a.data(), a.data() + a.size(), b.data());
}

bool same_colour(const Image<Rgb8>& a, const Image<Rgb8>& b) {
  return a.width() == b.width() && a.height() == b.height() &&
         std::equal(a.data(), a.data() + a.size(), b.data(), [](Rgb8 p, Rgb8 q) { return p.r == q.r && p.g == q.g && p.b == q.b; });
}

}  // namespace

TEST_CASE("SevenScenesWriter: what it writes, open_sequence reads back") {
  const TempFolder temp;
  const std::string folder = temp / "recording";
  write_small_recording(folder, 3);
  const auto sequence = open_sequence(folder, Context());
  CHECK(sequence->name() == "recording");
  REQUIRE(sequence->num_frames() == 3);
  for (int i = 0; i < 3; ++i) {
    const RgbdFrame expected = small_frame(i);
    const RgbdFrame frame = sequence->load(i);
    CHECK(describe_frame_error(frame.view()).empty());
    CHECK(same_depth(frame.depth, expected.depth));
    CHECK(same_colour(frame.colour, expected.colour));
    CHECK(frame.index == i);
    CHECK(frame.timestamp_s == Approx(expected.timestamp_s).epsilon(1e-9));
    CHECK(frame.calibration.depth.fy == expected.calibration.depth.fy);
    CHECK(frame.calibration.depth.cy == expected.calibration.depth.cy);
    REQUIRE(frame.world_from_camera.has_value());
    CHECK(translation_distance_m(*frame.world_from_camera, *expected.world_from_camera) < 1e-6F);
    CHECK(rotation_distance_rad(*frame.world_from_camera, *expected.world_from_camera) < 1e-6F);
  }
}

TEST_CASE("SevenScenesWriter: an unregistered calibration survives, and is played registered unless asked otherwise") {
  const TempFolder temp;
  RgbdFrame frame = small_frame(0);
  frame.calibration.colour = {33.0F, 34.0F, 15.0F, 12.0F};
  Tangent6 tangent;
  tangent << 0.01F, 0.02F, 0.03F, 0.025F, 0.0F, -0.001F;
  frame.calibration.depth_from_colour = se3_exp(tangent);
  SevenScenesWriter writer(temp.path());
  writer.write(frame);
  SequenceOptions as_recorded;
  as_recorded.register_colour = false;
  const RgbdFrame read = open_sequence(temp.path(), Context(), as_recorded)->load(0);
  CHECK(same_colour(read.colour, frame.colour));
  CHECK(read.calibration.colour.fx == 33.0F);
  CHECK(translation_distance_m(read.calibration.depth_from_colour, frame.calibration.depth_from_colour) < 1e-7F);
  CHECK(rotation_distance_rad(read.calibration.depth_from_colour, frame.calibration.depth_from_colour) < 1e-6F);

  const RgbdFrame registered = open_sequence(temp.path(), Context())->load(0);
  CHECK(is_registered(registered.calibration));
  CHECK(registered.calibration.colour.fx == frame.calibration.depth.fx);
  register_colour(frame);  // a recording is as good as the camera
  CHECK(same_colour(registered.colour, frame.colour));
}

TEST_CASE("SevenScenesWriter: colour may have another size than depth, and is played registered") {
  const TempFolder temp;
  RgbdFrame frame = small_frame(0);
  frame.colour = Image<Rgb8>(2 * kTestWidth, 2 * kTestHeight, {90, 80, 70});
  frame.calibration.colour = frame.calibration.depth.scaled(2.0F);
  {
    SevenScenesWriter writer(temp.path());
    writer.write(frame);
    writer.finish();
  }
  const auto recording = open_recording(temp.path(), Context());
  CHECK(recording->facts().colour_width == 2 * kTestWidth);
  CHECK(recording->facts().calibration.colour.fx == frame.calibration.colour.fx);
  const RgbdFrame read = recording->load(0);
  CHECK(describe_frame_error(read.view()).empty());
  CHECK(read.colour(3, 3).g == 80);
}

TEST_CASE("SevenScenesWriter: depth that millimetres cannot hold becomes no measurement") {
  const TempFolder temp;
  RgbdFrame frame = small_frame(0);
  frame.depth(1, 0) = -1.0F;
  frame.depth(2, 0) = std::numeric_limits<float>::quiet_NaN();
  frame.depth(3, 0) = 65.535F;
  frame.depth(4, 0) = 65.534F;
  SevenScenesWriter writer(temp.path());
  writer.write(frame);
  const RgbdFrame read = open_sequence(temp.path(), Context())->load(0);
  for (int u = 0; u < 4; ++u) CHECK(read.depth(u, 0) == 0.0F);
  CHECK(read.depth(4, 0) == 65.534F);
}

TEST_CASE("round_depth_as_recorded: changes depth to what is read back, bit by bit") {
  const TempFolder temp;
  RgbdFrame frame = small_frame(0);
  for (int u = 0; u < kTestWidth; ++u) frame.depth(u, 3) = 0.7F + 0.0123456F * static_cast<float>(u);
  frame.depth(1, 0) = -1.0F;
  frame.depth(2, 0) = std::numeric_limits<float>::quiet_NaN();
  frame.depth(3, 0) = 65.535F;
  SevenScenesWriter writer(temp.path());
  writer.write(frame);
  round_depth_as_recorded(frame.depth);
  CHECK(same_depth(frame.depth, open_sequence(temp.path(), Context())->load(0).depth));
}

TEST_CASE("SevenScenesWriter: refuses a folder that holds frames, and a file in the folder's place") {
  const TempFolder temp;
  write_small_recording(temp.path(), 1);
  CHECK_THAT(error_of([&] { SevenScenesWriter writer(temp.path()); }), Contains(temp.path()) && Contains("holds frames already"));
  write_text(temp / "file", "");
  CHECK_THAT(error_of([&] { SevenScenesWriter writer(temp / "file"); }), Contains(temp / "file"));
}

TEST_CASE("SevenScenesWriter: a frame that cannot be written leaves the recording as it was") {
  const TempFolder temp;
  SevenScenesWriter writer(temp.path());
  writer.write(small_frame(0));
  fs::create_directory(temp / "frame-000001.pose.txt");  // in the way
  CHECK_THAT(error_of([&] { writer.write(small_frame(1)); }), Contains("frame-000001.pose.txt"));
  CHECK(writer.num_frames() == 1);
  CHECK(open_sequence(temp.path(), Context())->num_frames() == 1);
}

}  // namespace foothold

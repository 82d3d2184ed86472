// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include <algorithm>

#include "foothold/frames/register_colour.h"
#include "foothold/io/image_file.h"
#include "foothold/io/sequence.h"
#include "foothold/io/seven_scenes_writer.h"
#include "io_fixtures.h"
#include "lost_identities.h"
#include "room_recording.h"
#include "support/catch.h"

namespace foothold {
namespace {

using namespace test;
using Catch::Matchers::Contains;
namespace fs = std::filesystem;

const char* const kPose = "frame-000001.pose.txt";

/// A pose with one entry replaced.
std::string pose_text(const std::string& first_entry, const std::string& last_row = "0 0 0 1") {
  return first_entry + " 0 0 1\n0 1 0 2\n0 0 1 3\n" + last_row + "\n";
}

}  // namespace

TEST_CASE("open_sequence: a 7-Scenes folder without poses has frames without poses") {
  const TempFolder temp;
  SevenScenesWriter writer(temp.path());
  RgbdFrame frame = small_frame(0);
  frame.world_from_camera.reset();
  writer.write(frame);
  CHECK_FALSE(open_sequence(temp.path(), Context())->load(0).world_from_camera.has_value());
}

TEST_CASE("open_sequence: without timestamps, frames are a thirtieth of a second apart") {
  const TempFolder temp;
  write_small_recording(temp.path(), 2);
  fs::remove(temp / "timestamps.txt");
  CHECK(open_sequence(temp.path(), Context())->load(1).timestamp_s == Approx(1.0 / 30.0));
}

TEST_CASE("open_sequence: the intrinsics of 7-Scenes mean its unregistered colour camera, others a registered one") {
  const TempFolder temp;
  write_small_recording(temp.path(), 1);
  write_png(temp / "frame-000000.color.png", Image<Rgb8>(640, 480));  // the size of 7-Scenes' images
  write_png(temp / "frame-000000.depth.png", Image<std::uint16_t>(640, 480, 2000));
  write_text(temp / "camera-intrinsics.txt", "560 0 320 0 560 240 0 0 1");
  fs::remove(temp / "colour-intrinsics.txt");
  fs::remove(temp / "depth-from-colour.txt");

  const auto calibration = [&](bool registered) {
    SequenceOptions options;
    options.register_colour = registered;
    return open_sequence(temp.path(), Context(), options)->load(0).calibration;
  };
  const RgbdCalibration other = calibration(false);
  CHECK(other.colour.fx == other.depth.fx);
  CHECK(other.depth_from_colour.translation.isZero());

  for (const bool has_file : {true, false}) {
    write_text(temp / "camera-intrinsics.txt", "585 0 320\n0 585 240\n0 0 1\n");
    if (!has_file) fs::remove(temp / "camera-intrinsics.txt");
    const RgbdCalibration own = calibration(false);
    CHECK(own.depth.fx == 585.0F);
    CHECK(own.colour.fx == 525.0F);
    // The colour camera sits to the right, seen from the depth camera; docs/sequences.md.
    CHECK(own.depth_from_colour.translation.x() == Approx(0.0241).margin(1e-4));
    CHECK(is_rigid(own.depth_from_colour, 1e-6F));
    CHECK(is_registered(calibration(true)));
    CHECK(calibration(true).colour.fx == 585.0F);
  }
}

TEST_CASE("open_sequence: rotations are made orthonormal") {
  const TempFolder temp;
  write_small_recording(temp.path(), 2);
  write_text(temp / kPose, "0.9996 0 0 1\n0 1.0004 0 2\n0 0 1 3\n0 0 0 1\n");
  CHECK(is_rigid(*open_sequence(temp.path(), Context())->load(1).world_from_camera, 1e-6F));
}

TEST_CASE("open_sequence: a pose in brackets is read, as numerical programs print it") {
  const TempFolder temp;
  write_small_recording(temp.path(), 2);
  write_text(temp / kPose, GENERATE(as<std::string>{}, "[[ 1.  0.  0.  5.]\n [ 0.  1.  0.  6.]\n [ 0.  0.  1.  7.]\n [ 0.  0.  0.  1.]]\n",
                                    "[1, 0, 0, 5; 0, 1, 0, 6; 0, 0, 1, 7; 0, 0, 0, 1]"));
  CHECK(open_sequence(temp.path(), Context())->load(1).world_from_camera->translation == Eigen::Vector3f(5.0F, 6.0F, 7.0F));
}

TEST_CASE("open_sequence: poses that are all lost are warned of") {
  const TempFolder temp;
  write_small_recording(temp.path(), 2);
  write_text(temp / "frame-000000.pose.txt", "");
  write_text(temp / "frame-000001.pose.txt", pose_text("nan"));
  LoggingContext log;
  CHECK_FALSE(open_sequence(temp.path(), log.context)->load(1).world_from_camera.has_value());
  CHECK_THAT(log.warnings, Contains("none of its 2 frames has a pose"));
}

TEST_CASE("open_sequence: a pose that was written column by column is read so") {
  const TempFolder temp;
  write_small_recording(temp.path(), 2);
  write_text(temp / kPose, "0 1 0 0\n-1 0 0 0\n0 0 1 0\n5 6 7 1\n");
  const SE3 pose = *open_sequence(temp.path(), Context())->load(1).world_from_camera;
  CHECK(pose.translation == Eigen::Vector3f(5.0F, 6.0F, 7.0F));
  CHECK(pose.rotation(0, 1) == -1.0F);
  CHECK(pose.rotation(1, 0) == 1.0F);
}

TEST_CASE("open_sequence: an image that is missing or cut short makes a frame without depth, and one warning counts them") {
  const TempFolder temp;
  write_small_recording(temp.path(), 9);
  const std::string name = GENERATE(as<std::string>{}, "frame-000003.color.png", "frame-000003.depth.png", "frame-000008.depth.png");
  const bool is_missing = GENERATE(true, false);
  is_missing ? static_cast<void>(fs::remove(temp / name)) : truncate_file(temp / name, GENERATE(0.0, 0.5, 0.99));
  fs::remove(temp / "frame-000005.color.png");
  LoggingContext log;
  const auto sequence = open_sequence(temp.path(), log.context);
  REQUIRE(sequence->num_frames() == 9);
  for (int i = 0; i < 9; ++i) {
    const RgbdFrame frame = sequence->load(i);
    CHECK(describe_frame_error(frame.view()).empty());
    CHECK(frame.world_from_camera.has_value());
    const bool is_lost = i == 5 || temp / name == temp / ("frame-00000" + std::to_string(i) + name.substr(12));
    CHECK(std::any_of(frame.depth.data(), frame.depth.data() + frame.depth.size(), is_valid_depth) != is_lost);
  }
  const std::string first = name == "frame-000008.depth.png" ? "frame-000005.color.png" : name;
  CHECK_THAT(log.warnings, Contains("2 of its 9 frames cannot be read, and count as frames without depth") && Contains(temp / first));
}

TEST_CASE("open_sequence: an image whose damage shows only in its pixels makes a frame without depth, and is warned of once") {
  const TempFolder temp;
  write_small_recording(temp.path(), 6);
  for (const std::string name : {"frame-000002.depth.png", "frame-000004.color.png"}) {
    std::string bytes = read_text(temp / name);
    bytes[bytes.size() / 2] = static_cast<char>(bytes[bytes.size() / 2] ^ 0x55);
    write_text(temp / name, bytes);
  }
  LoggingContext log;
  const auto sequence = open_sequence(temp.path(), log.context);
  for (int i = 0; i < 6; ++i) {
    const RgbdFrame frame = sequence->load(i);
    CHECK(std::any_of(frame.depth.data(), frame.depth.data() + frame.depth.size(), is_valid_depth) == (i != 2 && i != 4));
  }
  CHECK_THAT(log.warnings, Contains("frame-000002.depth.png") && !Contains("frame-000004.color.png"));
}

TEST_CASE("open_sequence: a recording whose first frame, or half of its frames, cannot be read is refused") {
  const TempFolder temp;
  write_small_recording(temp.path(), 4);
  SECTION("the first") {
    const std::string name = GENERATE(as<std::string>{}, "frame-000000.color.png", "frame-000000.depth.png");
    GENERATE(true, false) ? static_cast<void>(fs::remove(temp / name)) : truncate_file(temp / name, 0.9);
    CHECK_THAT(reading_error(temp.path()), Contains(temp / name));
  }
  SECTION("half") {
    fs::remove(temp / "frame-000001.color.png");
    CHECK_NOTHROW(open_sequence(temp.path(), Context())->load(1));
    truncate_file(temp / "frame-000002.depth.png", 0.9);
    CHECK_THAT(reading_error(temp.path()), Contains(temp / "frame-000001.color.png") && Contains("2 of its 4 frames cannot be read"));
  }
}

TEST_CASE("open_sequence: the last frame of a recording that was killed may lack an image, and is left out with a warning") {
  const TempFolder temp;
  write_small_recording(temp.path(), 3);
  fs::remove(temp / "timestamps.txt");
  fs::remove(temp / GENERATE(as<std::string>{}, "frame-000002.color.png", "frame-000002.depth.png"));
  ContextOptions options;
  std::string warnings;
  options.log = [&](LogLevel level, const std::string& message) { warnings += level == LogLevel::kWarning ? message : ""; };
  CHECK(open_sequence(temp.path(), Context(options))->num_frames() == 2);
  CHECK_THAT(warnings, Contains("frame 2, the last, lacks an image and is left out"));
  fs::remove(temp / "frame-000001.depth.png");
  CHECK_THAT(reading_error(temp.path()), Contains("frame-000001.depth.png") && Contains("no such file"));
}

TEST_CASE("open_sequence: a gap in the numbering is frames without depth, a wide one is explained") {
  const TempFolder temp;
  write_small_recording(temp.path(), 4);
  for (const std::string suffix : {".color.png", ".depth.png", ".pose.txt"}) fs::remove(temp / ("frame-000002" + suffix));
  LoggingContext log;
  CHECK(open_sequence(temp.path(), log.context)->num_frames() == 4);
  CHECK_THAT(log.warnings, Contains("1 of its 4 frames cannot be read") && Contains("frame-000002.depth.png"));
  for (const std::string suffix : {".color.png", ".depth.png", ".pose.txt"})
    fs::rename(temp / ("frame-000003" + suffix), temp / ("frame-000030" + suffix));
  CHECK_THAT(reading_error(temp.path()), Contains("frame-000002.depth.png") && Contains("numbered from 0") && Contains("frame 30"));
  for (const std::string suffix : {".color.png", ".depth.png", ".pose.txt"}) fs::remove(temp / ("frame-000000" + suffix));
  CHECK_THAT(reading_error(temp.path()), Contains("frame-000000.depth.png") && Contains("from 0"));
}

TEST_CASE("open_sequence: a damaged image is named") {
  const TempFolder temp;
  write_small_recording(temp.path(), 2);
  const std::string path = temp / GENERATE(as<std::string>{}, "frame-000001.color.png", "frame-000001.depth.png");
  SECTION("cut short") {
    truncate_file(path, GENERATE(0.0, 0.01, 0.5, 0.99));
    CHECK_THAT(reading_error(temp.path()), Contains(path) && Contains("expected a complete PNG or JPEG image"));
  }
  SECTION("a byte changed in the middle") {
    std::string bytes = read_text(path);
    bytes[bytes.size() / 2] = static_cast<char>(bytes[bytes.size() / 2] ^ 0x55);
    write_text(path, bytes);
    CHECK_THAT(reading_error(temp.path()), Contains(path));
  }
  SECTION("another kind of file") {
    write_text(path, "GIF89a and so on");
    CHECK_THAT(reading_error(temp.path()), Contains(path) && Contains("signature"));
  }
}

TEST_CASE("open_sequence: depth must be 16 bits, and colour of the shape of its camera's images") {
  const TempFolder temp;
  write_small_recording(temp.path(), 1);
  SECTION("kind of pixel") {
    write_png(temp / "frame-000000.depth.png", Image<Rgb8>(kTestWidth, kTestHeight));
    CHECK_THAT(reading_error(temp.path()),
               Contains("frame-000000.depth.png") && Contains("3 channel(s) of 8 bits") && Contains("one channel of 16 bits"));
  }
  SECTION("size") {
    fs::remove(temp / "colour-intrinsics.txt");  // with its own camera, colour may have any size
    write_png(temp / "frame-000000.color.png", Image<Rgb8>(kTestWidth, kTestHeight + 1));
    CHECK_THAT(reading_error(temp.path()), Contains("32x25") && Contains("32x24"));
  }
}

TEST_CASE("open_sequence: a bad pose is named, with the value") {
  const TempFolder temp;
  write_small_recording(temp.path(), 2);
  struct Case {
    std::string text;
    std::string value;
  };
  const Case bad = GENERATE(values<Case>({{"1 0 0 1\n0 1 0 2\n0 0 1", "11 numbers"},
                                          {pose_text("one"), "'one'"},
                                          {pose_text("1,0"), "'1,0'"},
                                          {pose_text("1.02"), "a rotation"},
                                          {pose_text("-1"), "determinant -1"},
                                          {pose_text("0"), "a rotation"},
                                          {pose_text("1e300"), "a rotation"},
                                          {pose_text("1", "0 0 0 2"), "0 0 0 2"},
                                          {pose_text("1") + "5", "17 numbers"}}));
  write_text(temp / kPose, bad.text);
  CAPTURE(bad.text);
  CHECK_THAT(reading_error(temp.path()), Contains(temp / kPose) && Contains(bad.value) && Contains("expected"));
}

TEST_CASE("open_sequence: a frame whose pose is lost or missing comes without one, and a warning counts them") {
  const TempFolder temp;
  write_small_recording(temp.path(), 4);
  const std::string lost = GENERATE(as<std::string>{}, "", "\n", pose_text("nan"), pose_text("inf"), pose_text("-1.#IND"),
                                    pose_text("-nan(ind)"), "nan nan nan nan nan nan nan nan nan nan nan nan nan nan nan nan",
                                    "-inf -inf -inf -inf\n-inf -inf -inf -inf\n-inf -inf -inf -inf\n-inf -inf -inf -inf\n",
                                    "0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0", "(no file)");
  write_text(temp / kPose, lost);
  if (lost == "(no file)") fs::remove(temp / kPose);
  CAPTURE(lost);
  LoggingContext log;
  const auto sequence = open_sequence(temp.path(), log.context);
  REQUIRE(sequence->num_frames() == 4);
  for (int i = 0; i < 4; ++i) CHECK(sequence->load(i).world_from_camera.has_value() == (i != 1));
  CHECK_THAT(log.warnings, Contains("1 of its 4 frames have no pose") && Contains("frame 1"));
}

TEST_CASE("open_sequence: poses that a logger wrote as the identity where tracking was lost come without one, and a warning counts them") {
  const TempFolder temp;
  constexpr int kNumFrames = 20;
  write_small_recording(temp.path(), kNumFrames);
  const std::string identity = "1 0 0 0\n0 1 0 0\n0 0 1 0\n0 0 0 1\n";
  for (const char* name : {"frame-000007.pose.txt", "frame-000008.pose.txt", "frame-000019.pose.txt"}) write_text(temp / name, identity);
  LoggingContext log;
  const auto sequence = open_sequence(temp.path(), log.context);
  for (int i = 0; i < kNumFrames; ++i) {
    CHECK(sequence->load(i).world_from_camera.has_value() == (i != 7 && i != 8 && i != kNumFrames - 1));
  }
  CHECK_THAT(log.warnings, Contains("3 of its 20 poses are the identity") && Contains("3 of its 20 frames have no pose"));
}

TEST_CASE("find_lost_identities: leaves a camera alone that begins at the identity, comes back to it, or leaps anyway") {
  const auto path = [](double step_m, int num_poses) {
    std::vector<std::optional<io::RecordedPose>> poses(static_cast<std::size_t>(num_poses), io::RecordedPose{});
    for (int i = 0; i < num_poses; ++i) poses[static_cast<std::size_t>(i)]->translation_m.x() = step_m * (i - num_poses / 2);
    return poses;
  };
  constexpr int kNumPoses = 40;
  CHECK(io::find_lost_identities(path(0.05, kNumPoses)).empty());  // passes through it
  CHECK(io::find_lost_identities(path(0.6, kNumPoses)).empty());   // in long steps
  auto poses = path(0.05, kNumPoses);
  for (std::size_t i = 0; i < 3; ++i) poses[i] = io::RecordedPose{};
  CHECK(io::find_lost_identities(poses).empty());  // begins there
  poses[30] = io::RecordedPose{};                  // half a metre away, but no further
  CHECK(io::find_lost_identities(poses).empty());
  poses[35] = io::RecordedPose{};
  CHECK(io::find_lost_identities(poses) == std::vector<std::size_t>{35});
  poses[34].reset();  // who knows where the camera was
  CHECK(io::find_lost_identities(poses).empty());
  CHECK(io::find_lost_identities(std::vector<std::optional<io::RecordedPose>>(kNumPoses, io::RecordedPose{})).empty());
}

TEST_CASE("open_sequence: bad intrinsics are named, with the value") {
  const TempFolder temp;
  write_small_recording(temp.path(), 1);
  const std::string name = GENERATE(as<std::string>{}, "camera-intrinsics.txt", "colour-intrinsics.txt");
  struct Case {
    std::string text;
    std::string value;
  };
  const Case bad = GENERATE(values<Case>({{"0 0 16 0 40 12 0 0 1", "focal length of 0 "},
                                          {"-40 0 16 0 40 12 0 0 1", "-40"},
                                          {"40 0 16 0 -40.5 12 0 0 1", "-40.5"},
                                          {"40 0 nan 0 40 12 0 0 1", "'nan'"},
                                          {"40 1 16 0 40 12 0 0 1", "40 1 16"},
                                          {"40 40 16", "3 numbers"}}));
  write_text(temp / name, bad.text);
  CHECK_THAT(reading_error(temp.path()), Contains(temp / name) && Contains(bad.value) && Contains("expected"));
}

TEST_CASE("open_sequence: timestamps must fit the frames") {
  const TempFolder temp;
  write_small_recording(temp.path(), 2);
  const std::string text = GENERATE(as<std::string>{}, "0 1.0\n", "0 1.0\n1 1.1\n2 1.2\n", "0 1.0\n2 1.1\n", "0 1.0\n1\n", "0 1.0\n1 x\n");
  write_text(temp / "timestamps.txt", text);
  CHECK_THAT(reading_error(temp.path()), Contains(temp / "timestamps.txt") && Contains("expected"));
}

TEST_CASE("open_sequence: says what is wrong with a folder that holds no recording") {
  const TempFolder temp;
  CHECK_THAT(reading_error(temp.path()), Contains(temp.path()) && Contains("empty folder"));
  CHECK_THAT(reading_error(temp / "absent"), Contains(temp / "absent") && Contains("no such folder"));
  write_text(temp / "note.txt", "");
  CHECK_THAT(reading_error(temp.path()), Contains("another kind") && Contains("7-Scenes") && Contains("TUM"));
  CHECK_THAT(reading_error(temp / "note.txt"), Contains("got a file"));
  write_text(temp / "TrainSplit.txt", "sequence1\n");
  CHECK_THAT(reading_error(temp.path()), Contains("scene") && Contains("seq-01"));
}

}  // namespace foothold

// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "tum_sequence.h"

#include "foothold/io/image_file.h"
#include "foothold/io/trajectory.h"
#include "io_fixtures.h"
#include "room_recording.h"
#include "support/catch.h"

namespace foothold {
namespace {

using namespace test;
using Catch::Matchers::Contains;
namespace fs = std::filesystem;

/// Images of the size of the benchmark's.
void write_images(const std::string& folder, const std::string& name, int value) {
  fs::create_directories(folder + "/depth");
  fs::create_directories(folder + "/rgb");
  write_png(folder + "/depth/" + name + ".png", Image<std::uint16_t>(640, 480, static_cast<std::uint16_t>(5000 + value)));
  write_png(folder + "/rgb/" + name + ".png", Image<Rgb8>(640, 480, {static_cast<std::uint8_t>(value), 0, 0}));
}

/// A recording of three frames at 1.0, 1.1 and 1.2 s, colour 5 ms later; ground truth moves along x at 1 m/s, sampled between the frames.
void write_tum_recording(const std::string& folder) {
  for (int i = 0; i < 3; ++i) write_images(folder, std::to_string(i), i);
  write_text(folder + "/depth.txt", "# depth maps\n1.0 depth/0.png\n1.1 depth/1.png\n1.2 depth/2.png\n");
  write_text(folder + "/rgb.txt", "# colour\n1.005 rgb/0.png\n1.105 rgb/1.png\n1.205 rgb/2.png\n");
  write_text(
      folder + "/groundtruth.txt",
      "# truth\n0.96 0.96 0 0 0 0 0 1\n1.04 1.04 0 0 0 0 0 1\n1.08 1.08 0 0 0 0 0 1\n1.14 1.14 0 0 0 0 0 1\n1.22 1.22 0 0 0 0 0 1\n");
}

std::vector<io::StampedFile> stamped(const std::vector<double>& times_s) {
  std::vector<io::StampedFile> files;
  for (const double time_s : times_s) files.push_back({time_s, std::to_string(time_s)});
  return files;
}

}  // namespace

TEST_CASE("open_sequence: reads a TUM folder, depth in fifths of a millimetre, poses interpolated") {
  const TempFolder temp;
  const std::string folder = temp / "rgbd_dataset_freiburg2_desk";
  write_tum_recording(folder);
  const auto sequence = open_sequence(folder, Context());
  CHECK(sequence->name() == "rgbd_dataset_freiburg2_desk");
  REQUIRE(sequence->num_frames() == 3);
  for (int i = 0; i < 3; ++i) {
    const RgbdFrame frame = sequence->load(i);
    CHECK(describe_frame_error(frame.view()).empty());
    CHECK(frame.depth(300, 300) == static_cast<float>(5000 + i) / 5000.0F);
    CHECK(frame.colour(300, 300).r == i);
    CHECK(frame.timestamp_s == Approx(1.0 + 0.1 * i));
    REQUIRE(frame.world_from_camera.has_value());
    CHECK(frame.world_from_camera->translation.x() == Approx(1.0 + 0.1 * i).epsilon(1e-6));
    CHECK(frame.calibration.depth.fx == 520.9F);
    CHECK(frame.calibration.colour.fx == 520.9F);
  }
}

TEST_CASE("open_sequence: a TUM folder's camera is told by its file, its name, or is ROS's default") {
  struct Case {
    std::string name;
    float fx;
  };
  const Case c = GENERATE(values<Case>({{"rgbd_dataset_freiburg1_xyz", 517.3F},
                                        {"freiburg3_long", 535.4F},
                                        {"fr2_desk", 520.9F},
                                        {"tum-fr3-teddy", 535.4F},
                                        {"fr15", 525.0F},
                                        {"from3", 525.0F},
                                        {"room", 525.0F}}));
  const TempFolder temp;
  write_tum_recording(temp / c.name);
  CHECK(open_sequence(temp / c.name, Context())->load(0).calibration.depth.fx == c.fx);
  write_text(temp / (c.name + "/camera-intrinsics.txt"), "400 0 320 0 401 240 0 0 1");
  CHECK(open_sequence(temp / c.name, Context())->load(0).calibration.depth.fx == 400.0F);
}

TEST_CASE("open_sequence: TUM frames without ground truth, or where it was lost, come without a pose, and a warning counts them") {
  const TempFolder temp;
  write_tum_recording(temp.path());
  const std::string truth =
      GENERATE(as<std::string>{}, "0.99 0 0 0 0 0 0 1\n1.05 0 0 0 0 0 0 1\n1.19 0 0 0 0 0 0 1\n1.21 0 0 0 0 0 0 1\n",
               "0.99 0 0 0 0 0 0 1\n1.05 0 0 0 0 0 0 1\n1.09 nan nan nan nan nan nan nan\n1.15 0 0 0 0 0 0 1\n1.21 0 0 0 0 0 0 1\n",
               "0.99 0 0 0 0 0 0 1\n1.05 0 0 0 0 0 0 1\n1.1 0 0 0 0 0 0 0\n1.15 0 0 0 0 0 0 1\n1.21 0 0 0 0 0 0 1\n");
  write_text(temp / "groundtruth.txt", truth);
  LoggingContext log;
  const auto sequence = open_sequence(temp.path(), log.context);
  REQUIRE(sequence->num_frames() == 3);
  CHECK(sequence->load(0).world_from_camera.has_value());
  CHECK_FALSE(sequence->load(1).world_from_camera.has_value());
  CHECK(sequence->load(2).world_from_camera.has_value());
  CHECK_THAT(log.warnings, Contains("1 of its 3 frames have no pose"));
}

TEST_CASE("open_sequence: ground truth that was lost throughout leaves frames without poses, with a warning") {
  const TempFolder temp;
  write_tum_recording(temp.path());
  write_text(temp / "groundtruth.txt", "0.9 nan nan nan nan nan nan nan\n1.05 0 0 0 0 0 0 0\n1.3 nan nan nan nan nan nan nan\n");
  LoggingContext log;
  CHECK_FALSE(open_sequence(temp.path(), log.context)->load(0).world_from_camera.has_value());
  CHECK_THAT(log.warnings, Contains("none of its 3 frames has a pose"));
  write_text(temp / "groundtruth.txt", "0.5 0 0 0 0 0 0 1\n1.8 0 0 0 0 0 0 1\n");
  CHECK_THAT(reading_error(temp.path()), Contains("no pose within 0.1 s"));
}

TEST_CASE("open_sequence: a TUM folder without ground truth has frames without poses") {
  const TempFolder temp;
  write_tum_recording(temp.path());
  fs::remove(temp / "groundtruth.txt");
  const auto sequence = open_sequence(temp.path(), Context());
  REQUIRE(sequence->num_frames() == 3);
  CHECK_FALSE(sequence->load(0).world_from_camera.has_value());
}

TEST_CASE("open_sequence: each thing wrong with a TUM folder is named") {
  const TempFolder temp;
  write_tum_recording(temp.path());
  const auto breaks = [&](const std::string& name, const std::string& text) {
    write_text(temp / name, text);
    const std::string error = reading_error(temp.path());
    CHECK_THAT(error, Contains(temp / name));
    return error;
  };
  SECTION("missing list") {
    fs::remove(temp / "rgb.txt");
    CHECK_THAT(reading_error(temp.path()), Contains(temp / "rgb.txt") && Contains("no such file"));
  }
  SECTION("missing image") {
    fs::remove(temp / "rgb/0.png");
    CHECK_THAT(reading_error(temp.path()), Contains(temp / "rgb/0.png") && Contains("no such file"));
  }
  SECTION("damaged image") {
    truncate_file(temp / "depth/0.png", 0.7);
    CHECK_THAT(reading_error(temp.path()), Contains(temp / "depth/0.png"));
  }
  SECTION("empty list") { CHECK_THAT(breaks("depth.txt", "# nothing\n"), Contains("no image")); }
  SECTION("bad line") { CHECK_THAT(breaks("rgb.txt", "1.0 rgb/0.png\n1.1\n"), Contains("line 2") && Contains("1 words")); }
  SECTION("bad time") { CHECK_THAT(breaks("rgb.txt", "noon rgb/0.png\n"), Contains("line 1") && Contains("'noon'")); }
  SECTION("lists of different recordings") {
    CHECK_THAT(breaks("depth.txt", "9.0 depth/0.png\n9.1 depth/1.png\n"),
               Contains("20 ms") && Contains("9.000000") && Contains("1.205000") && Contains("seconds"));
  }
  SECTION("decimal commas between blanks") {
    CHECK_THAT(breaks("rgb.txt", "1,005 rgb/0.png\n"), Contains("'1,005'") && Contains("decimal point"));
  }
  SECTION("images outside the folder") {
    CHECK_THAT(breaks("rgb.txt", "1.0 ..\\elsewhere\\0.png\n"), Contains("'../elsewhere/0.png'"));
    CHECK_THAT(breaks("rgb.txt", "1.0 ../elsewhere/0.png\n"), Contains("'../elsewhere/0.png'") && Contains("line 1"));
    CHECK_THAT(breaks("rgb.txt", "1.0 /elsewhere/0.png\n"), Contains("'/elsewhere/0.png'"));
  }
  SECTION("ground truth of another recording") {
    CHECK_THAT(breaks("groundtruth.txt", "9 0 0 0 0 0 0 1\n"),
               Contains("no pose at the time") && Contains("9.000000") && Contains("seconds"));
  }
  SECTION("negative intrinsics") { CHECK_THAT(breaks("camera-intrinsics.txt", "525 0 320 0 -525 240 0 0 1"), Contains("-525")); }
}

TEST_CASE("open_sequence: frames beside a sample of the ground truth that is the identity, where tracking was lost, come without a pose") {
  const TempFolder temp;
  write_tum_recording(temp.path());
  std::string truth;
  for (int i = 0; i <= 30; ++i) {
    const std::string time = std::to_string(0.95 + 0.01 * i);
    truth += time + (i == 15 ? " 0 0 0 0 0 0 1\n" : " " + time + " 0 0 0 0 0 1\n");  // at 1.1 s, a frame's time
  }
  write_text(temp / "groundtruth.txt", truth);
  LoggingContext log;
  const auto sequence = open_sequence(temp.path(), log.context);
  for (int i = 0; i < 3; ++i) CHECK(sequence->load(i).world_from_camera.has_value() == (i != 1));
  CHECK_THAT(log.warnings, Contains("groundtruth.txt: 1 of its 31 poses are the identity"));
}

TEST_CASE("open_sequence: an image of a TUM folder that is missing or cut short makes a frame without depth") {
  const TempFolder temp;
  write_tum_recording(temp.path());
  const std::string file = temp / GENERATE(as<std::string>{}, "rgb/1.png", "depth/1.png");
  GENERATE(true, false) ? static_cast<void>(fs::remove(file)) : truncate_file(file, 0.7);
  LoggingContext log;
  const auto sequence = open_sequence(temp.path(), log.context);
  REQUIRE(sequence->num_frames() == 3);
  CHECK(sequence->load(1).depth(300, 300) == 0.0F);
  CHECK(sequence->load(1).world_from_camera.has_value());
  CHECK(sequence->load(2).depth(300, 300) > 0.0F);
  CHECK_THAT(log.warnings, Contains("1 of its 3 frames cannot be read") && Contains(file));
}

TEST_CASE("open_sequence: a TUM list by Windows, a spreadsheet or a logger reads like any other") {
  const TempFolder temp;
  write_tum_recording(temp.path());
  const auto rewrite = [&](const std::string& name, const std::string& text) { write_text(temp / name, text); };
  SECTION("byte-order mark and Windows' line ends") {
    rewrite("rgb.txt", "\xef\xbb\xbf# colour\r\n1.005 rgb/0.png\r\n1.105 rgb/1.png\r\n1.205 rgb/2.png\r\n");
  }
  SECTION("UTF-16") {
    const std::string plain = "1.0 depth/0.png\n1.1 depth/1.png\n1.2 depth/2.png\n";
    std::string wide = "\xff\xfe";
    for (const char c : plain) wide += {c, '\0'};
    rewrite("depth.txt", wide);
  }
  SECTION("UTF-16 without a byte-order mark, and lines that are there twice") {
    const std::string plain = "sec file\n1.0 depth/0.png\n1.0 depth/0.png\n1.1 depth/1.png\n1.2 depth/2.png\n1.2 depth/2.png\n";
    std::string wide;
    for (const char c : plain) wide += {c, '\0'};
    rewrite("depth.txt", wide);
  }
  SECTION("old line ends") { rewrite("rgb.txt", "# colour\r1.005 rgb/0.png\r1.105 rgb/1.png\r1.205 rgb/2.png\r"); }
  SECTION("comma-separated, with a heading and quotes") {
    rewrite("rgb.txt", "timestamp,filename\n1.005,\"rgb/0.png\"\n1.105,\"rgb/1.png\"\n1.205,\"rgb/2.png\"\n");
    rewrite("groundtruth.txt",
            "timestamp, tx, ty, tz, qx, qy, qz, qw\n0.96, 0.96, 0, 0, 0, 0, 0, 1\n1.04, 1.04, 0, 0, 0, 0, 0, 1\n1.08, 1.08, 0, 0, "
            "0, 0, 0, 1\n1.14, 1.14, 0, 0, 0, 0, 0, 1\n1.22, 1.22, 0, 0, 0, 0, 0, 1\n");
  }
  SECTION("semicolons and decimal commas") {
    rewrite("groundtruth.txt",
            "0,96;0,96;0;0;0;0;0;1\n1,04;1,04;0;0;0;0;0;1\n1,08;1,08;0;0;0;0;0;1\n1,14;1,14;0;0;0;0;0;1\n1,22;1,22;0;0;0;0;0;1\n");
  }
  SECTION("tabs and decimal commas") {
    rewrite("depth.txt", "1,0\tdepth/0.png\n1,1\tdepth/1.png\n1,2\tdepth/2.png\n");
    rewrite("groundtruth.txt",
            "0,96\t0,96\t0\t0\t0\t0\t0\t1\n1,04\t1,04\t0\t0\t0\t0\t0\t1\n1,08\t1,08\t0\t0\t0\t0\t0\t1\n1,14\t1,14\t0\t0\t0\t0\t0\t1\n"
            "1,22\t1,22\t0\t0\t0\t0\t0\t1\n");
  }
  SECTION("Windows' separators of folders") { rewrite("rgb.txt", "1.005 rgb\\0.png\n1.105 .\\rgb\\1.png\n1.205 rgb\\2.png\n"); }
  SECTION("associations, in milliseconds") {
    fs::remove(temp / "rgb.txt");
    fs::remove(temp / "depth.txt");
    rewrite("associations.txt", "1005 rgb/0.png 1000 depth/0.png\n1105 rgb/1.png 1100 depth/1.png\n1205 rgb/2.png 1200 depth/2.png\n");
  }
  SECTION("ground truth in milliseconds, from long before the recording") {
    std::string truth = "0 0 0 0 0 0 0 1\n";
    for (int ms = 8; ms < 1300; ms += 8) truth += std::to_string(ms) + " " + std::to_string(0.001 * ms) + " 0 0 0 0 0 1\n";
    rewrite("groundtruth.txt", truth);
  }
  SECTION("milliseconds") {
    rewrite("rgb.txt", "1005 rgb/0.png\n1105 rgb/1.png\n1205 rgb/2.png\n");
    rewrite("depth.txt", "1000 depth/0.png\n1100 depth/1.png\n1200 depth/2.png\n");
  }
  SECTION("nanoseconds, and the ground truth in microseconds") {
    rewrite("rgb.txt", "1005000000 rgb/0.png\n1105000000 rgb/1.png\n1205000000 rgb/2.png\n");
    rewrite("depth.txt", "1000000000 depth/0.png\n1100000000 depth/1.png\n1200000000 depth/2.png\n");
    rewrite("groundtruth.txt",
            "960000 0.96 0 0 0 0 0 1\n1040000 1.04 0 0 0 0 0 1\n1080000 1.08 0 0 0 0 0 1\n1140000 1.14 0 0 0 0 0 1\n1220000 1.22 "
            "0 0 0 0 0 1\n");
  }
  const auto sequence = open_sequence(temp.path(), Context());
  REQUIRE(sequence->num_frames() == 3);
  for (int i = 0; i < 3; ++i) {
    const RgbdFrame frame = sequence->load(i);
    CHECK(frame.timestamp_s == Approx(1.0 + 0.1 * i));
    CHECK(frame.colour(300, 300).r == i);
    REQUIRE(frame.world_from_camera.has_value());
    CHECK(frame.world_from_camera->translation.x() == Approx(1.0 + 0.1 * i).epsilon(1e-6));
  }
}

TEST_CASE("associate: nearest pairs first, each image once, none further apart than allowed") {
  const auto pairs = io::associate(stamped({1.000, 1.033, 1.066, 1.200}), stamped({1.004, 1.020, 1.070, 1.230}), 0.02);
  REQUIRE(pairs.size() == 3);
  CHECK(pairs[0].colour.timestamp_s == 1.004);
  CHECK(pairs[1].colour.timestamp_s == 1.020);
  CHECK(pairs[2].colour.timestamp_s == 1.070);
  // Both depth images are nearest to 1.010, which goes to the nearer one; the other takes what is left.
  const auto contested = io::associate(stamped({1.000, 1.012}), stamped({0.985, 1.010}), 0.02);
  REQUIRE(contested.size() == 2);
  CHECK(contested[0].colour.timestamp_s == 0.985);
  CHECK(contested[1].colour.timestamp_s == 1.010);
  CHECK(io::associate(stamped({1.0}), stamped({1.1}), 0.02).empty());
}

TEST_CASE("open_sequence: in an ICL-NUIM folder, points land where its own convention puts them") {
  const TempFolder temp;
  for (int i = 1; i <= 2; ++i) write_images(temp.path(), std::to_string(i), i);
  write_text(temp / "associations.txt", "1 depth/1.png 1 rgb/1.png\n2 depth/2.png 2 rgb/2.png\n");
  Tangent6 tangent;
  tangent << 0.3F, 0.2F, -0.1F, 1.0F, 2.0F, 3.0F;
  write_trajectory(temp / "livingRoom1.gt.freiburg", {{1.0, SE3{}}, {2.0, se3_exp(tangent)}});
  const auto sequence = open_sequence(temp.path(), Context());
  REQUIRE(sequence->num_frames() == 2);
  const SE3 theirs = read_trajectory(temp / "livingRoom1.gt.freiburg")[1].world_from_camera;
  const RgbdFrame frame = sequence->load(1);
  CHECK(frame.timestamp_s == Approx(2.0 / 30.0));
  // Their camera: fy = -480, y upwards. Their point in their world, and ours in ours, are the same but for the mirrored y axis.
  const Intrinsics their_camera{481.2F, -480.0F, 319.5F, 239.5F};
  for (const Eigen::Vector2f& pixel : {Eigen::Vector2f(0.0F, 0.0F), Eigen::Vector2f(400.0F, 100.0F), Eigen::Vector2f(320.0F, 470.0F)}) {
    const Eigen::Vector3f their_point = theirs * their_camera.back_project(pixel.x(), pixel.y(), 1.5F);
    const Eigen::Vector3f our_point = *frame.world_from_camera * frame.calibration.depth.back_project(pixel.x(), pixel.y(), 1.5F);
    CHECK((our_point - Eigen::Vector3f(their_point.x(), -their_point.y(), their_point.z())).norm() < 1e-5F);
  }
  CHECK(is_rigid(*frame.world_from_camera, 1e-6F));
}

TEST_CASE("parse_associations: takes either order, and names a bad line") {
  const auto swapped = io::parse_associations("1.0 rgb/a.png 1.01 depth/a.png\n", "a.txt");
  REQUIRE(swapped.size() == 1);
  CHECK(swapped[0].depth.name == "depth/a.png");
  CHECK(swapped[0].depth.timestamp_s == 1.01);
  CHECK_THAT(error_of([] { io::parse_associations("1.0 rgb/a.png\n", "a.txt"); }), Contains("a.txt") && Contains("line 1"));
  CHECK_THAT(error_of([] { io::parse_associations("1 x/a.png 1 y/a.png\n", "a.txt"); }), Contains("depth"));
}

}  // namespace foothold

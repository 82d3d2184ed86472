// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// Which calibration a recording is read with, and where it comes from.
#include <filesystem>

#include "foothold/frames/register_colour.h"
#include "foothold/io/image_file.h"
#include "io_fixtures.h"
#include "room_recording.h"
#include "support/catch.h"

namespace foothold {
namespace {

using namespace test;
using Catch::Matchers::Contains;
namespace fs = std::filesystem;

std::string open_error(const std::string& folder, const SequenceOptions& options = {}) {
  return error_of<Error>([&] { open_sequence(folder, Context(), options); });
}

SequenceOptions with_intrinsics(const std::string& text) {
  SequenceOptions options;
  options.intrinsics = text;
  return options;
}

RoomFormat without_intrinsics() {
  RoomFormat format;
  format.intrinsics_file.clear();
  return format;
}

float room_fx() { return room_frames().front().calibration.depth.fx; }

}  // namespace

TEST_CASE("open_sequence: finds intrinsics where people put them, and says which and from where") {
  const TempFolder temp;
  const std::string folder = temp / "scene/seq-01";
  write_room_as_seven_scenes(folder, without_intrinsics());
  const std::string place =
      GENERATE(as<std::string>{}, "camera-intrinsics.txt", "../camera-intrinsics.txt", "intrinsic/intrinsic_depth.txt",
               "../calibration/depth_intrinsics.txt", "K.txt", "../calib.txt", "intrinsics.csv", "ost.yaml", "../cam0.yaml");
  CAPTURE(place);
  fs::create_directories(fs::path(folder + "/" + place).parent_path());
  write_text(folder + "/" + place, room_intrinsics_text());
  LoggingContext log;
  CHECK(open_sequence(folder, log.context)->load(0).calibration.depth.fx == room_fx());
  CHECK_THAT(log.messages,
             Contains(fs::path(place).filename().string()) && Contains("intrinsics " + std::to_string(room_fx()).substr(0, 6)));
  CHECK(log.warnings.empty());
}

TEST_CASE("open_sequence: the depth camera's file wins over the colour camera's and over one further up") {
  const TempFolder temp;
  const std::string folder = temp / "scene";
  write_room_as_seven_scenes(folder, without_intrinsics());
  fs::create_directories(folder + "/intrinsic");
  write_text(temp / "camera-intrinsics.txt", "150 0 80 0 150 60 0 0 1");
  write_text(folder + "/intrinsic/intrinsic_color.txt", "140 0 80 0 140 60 0 0 1");
  CHECK(open_sequence(folder, Context())->load(0).calibration.depth.fx == 140.0F);  // better than one of another folder
  write_text(folder + "/intrinsic/intrinsic_depth.txt", room_intrinsics_text());
  SequenceOptions as_recorded;
  as_recorded.register_colour = false;
  const RgbdCalibration read = open_sequence(folder, Context(), as_recorded)->load(0).calibration;
  CHECK(read.depth.fx == room_fx());
  CHECK(read.colour.fx == 140.0F);
}

TEST_CASE("open_sequence: without intrinsics, images of another size than the data set's are refused, with what would help") {
  const TempFolder temp;
  const std::string folder = temp / "scene/seq-01";
  SECTION("7-Scenes") { write_room_as_seven_scenes(folder, without_intrinsics()); }
  SECTION("TUM") { write_room_as_tum(folder, without_intrinsics()); }
  CHECK_THAT(open_error(folder),
             Contains("160x120") && Contains("640x480") && Contains("camera-intrinsics.txt") && Contains("--intrinsics"));
  CHECK(open_sequence(folder, Context(), with_intrinsics("146,146,79.5,59.5"))->load(0).calibration.depth.fx == 146.0F);
}

TEST_CASE("open_sequence: intrinsics that cannot be those of the images are refused, naming file, value and size") {
  struct Case {
    std::string text;
    std::string says;
  };
  const Case c = GENERATE(values<Case>({{"1170 0 647\n0 1170 484\n0 0 1\n", "647 484"},  // of larger images
                                        {"525 0 79.5\n0 525 59.5\n0 0 1\n", "525 525"},  // of larger images, recentred
                                        {"40 40 79.5 59.5", "40 40"},                    // of smaller ones
                                        {"292.5 292.5 159.5 119.5", "159.5 119.5"},      // of twice the size
                                        {"fx: 146\ncx: 79.5\ncy: 59.5\nwidth: 640\nheight: 360", "640x360"}}));
  const TempFolder temp;
  write_room_as_seven_scenes(temp.path(), without_intrinsics());
  write_text(temp / "camera-intrinsics.txt", c.text);
  CHECK_THAT(open_error(temp.path()), Contains(temp / "camera-intrinsics.txt") && Contains(c.says) && Contains("160x120"));
  CHECK_THAT(open_error(temp.path(), with_intrinsics(temp / "camera-intrinsics.txt")), Contains(c.says));
}

TEST_CASE("open_sequence: a principal point far from the middle is worth a warning") {
  const TempFolder temp;
  write_room_as_seven_scenes(temp.path(), without_intrinsics());
  write_text(temp / "camera-intrinsics.txt", "73 73 39.5 29.5");  // of half the size
  LoggingContext log;
  open_sequence(temp.path(), log.context);
  CHECK_THAT(log.warnings, Contains("39.5 29.5") && Contains("160x120"));
}

TEST_CASE("open_sequence: intrinsics that know their image size are resized to that of the recording") {
  const TempFolder temp;
  write_room_as_seven_scenes(temp.path(), without_intrinsics());
  write_text(temp / "camera-intrinsics.json", R"({"width": 640, "height": 480, "fx": 585, "fy": 585, "cx": 320, "cy": 240})");
  LoggingContext log;
  const Intrinsics k = open_sequence(temp.path(), log.context)->load(0).calibration.depth;
  CHECK(k.fx == 146.25F);
  CHECK(k.cx == 79.625F);
  CHECK_THAT(log.messages, Contains("resized from 640x480"));
}

TEST_CASE("open_sequence: intrinsics that are given win over every file, and may be a file themselves") {
  const TempFolder temp;
  write_room_as_seven_scenes(temp / "scene");
  write_text(temp / "mine.txt", "150 150 80 60");
  CHECK(open_sequence(temp / "scene", Context(), with_intrinsics("151, 152, 80, 60"))->load(0).calibration.depth.fy == 152.0F);
  CHECK(open_sequence(temp / "scene", Context(), with_intrinsics(temp / "mine.txt"))->load(0).calibration.depth.fx == 150.0F);
  CHECK_THAT(open_error(temp / "scene", with_intrinsics("585,585,320,240")), Contains("intrinsics that were given") && Contains("320 240"));
  CHECK_THAT(open_error(temp / "scene", with_intrinsics("1,2,3")), Contains("1,2,3") && Contains("3 numbers"));
  CHECK_THAT(open_error(temp / "scene", with_intrinsics(temp / "absent.txt")), Contains("absent.txt") && Contains("no such file"));
}

TEST_CASE("open_sequence: a file of both cameras gives each its own") {
  const TempFolder temp;
  write_room_as_seven_scenes(temp.path(), without_intrinsics());
  write_text(temp / "calibration.json", R"({"color": {"width": 320, "height": 240, "fx": 300, "fy": 300, "cx": 160, "cy": 120},
                                            "depth": {"width": 160, "height": 120, "fx": 146.25, "fy": 146.25, "cx": 79.625, "cy": 59.625}})");
  SequenceOptions as_recorded;
  as_recorded.register_colour = false;
  const RgbdCalibration read = open_sequence(temp.path(), Context(), as_recorded)->load(0).calibration;
  CHECK(read.depth.fx == room_fx());
  CHECK(read.colour.fx == 150.0F);  // its images have half the size of the camera's
}

TEST_CASE("open_sequence: colour of another size is registered to depth, by its own intrinsics or those of depth") {
  const TempFolder temp;
  write_room_as_seven_scenes(temp.path());
  const Image<Rgb8> small = room_frames().front().colour;
  for (int i = 0; i < 14; ++i) {
    Image<Rgb8> large(320, 240);
    for (int v = 0; v < 240; ++v) {
      for (int u = 0; u < 320; ++u) large(u, v) = room_frames()[static_cast<std::size_t>(i)].colour(u / 2, v / 2);
    }
    write_png(temp / ("frame-0000" + std::string(i < 10 ? "0" : "") + std::to_string(i) + ".color.png"), large);
  }
  const bool has_file = GENERATE(false, true);
  if (has_file) {
    const Intrinsics& k = room_frames().front().calibration.depth;
    write_text(temp / "colour-intrinsics.txt", std::to_string(2.0F * k.fx) + " " + std::to_string(2.0F * k.fy) + " " +
                                                   std::to_string(2.0F * k.cx + 0.5F) + " " + std::to_string(2.0F * k.cy + 0.5F));
  }
  SequenceOptions as_recorded;
  as_recorded.register_colour = false;
  for (const SequenceOptions& options : {SequenceOptions{}, as_recorded}) {
    const RgbdFrame frame = open_sequence(temp.path(), Context(), options)->load(0);
    CHECK(describe_frame_error(frame.view()).empty());
    CHECK(is_registered(frame.calibration));
    int num_same = 0;
    for (int v = 0; v < 120; ++v) {
      for (int u = 0; u < 160; ++u) num_same += std::abs(frame.colour(u, v).g - small(u, v).g) <= 2 ? 1 : 0;
    }
    CHECK(num_same > 0.99 * 160 * 120);
  }
  write_png(temp / "frame-000000.color.png", Image<Rgb8>(320, 200));
  if (!has_file) CHECK_THAT(open_error(temp.path()), Contains("320x200") && Contains("160x120") && Contains("colour-intrinsics.txt"));
}

TEST_CASE("open_sequence: a frame of another size than the first, and grey colour of 16 bits, are refused") {
  const TempFolder temp;
  write_room_as_seven_scenes(temp.path());
  const auto load = [&] { return error_of([&] { open_sequence(temp.path(), Context())->load(3); }); };
  SECTION("depth") {
    write_png(temp / "frame-000003.depth.png", Image<std::uint16_t>(80, 60, 1000));
    CHECK_THAT(load(), Contains("frame-000003.depth.png") && Contains("80x60") && Contains("160x120 as in the first frame"));
  }
  SECTION("colour") {
    write_png(temp / "frame-000003.color.png", Image<Rgb8>(80, 60));
    CHECK_THAT(load(), Contains("frame-000003.color.png") && Contains("80x60"));
  }
  SECTION("16 bits") {
    write_png(temp / "frame-000003.color.png", Image<std::uint16_t>(160, 120, 1000));
    CHECK_THAT(load(), Contains("frame-000003.color.png") && Contains("16 bits"));
  }
}

}  // namespace foothold

// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// Every layout but 7-Scenes' and TUM's: each test writes its recording and reads it back.
#include <zlib.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <sstream>

#include "foothold/io/image_file.h"
#include "io_fixtures.h"
#include "pose_lists.h"
#include "room_recording.h"
#include "sens_file.h"
#include "stray_scanner_sequence.h"
#include "support/catch.h"

namespace foothold {
namespace {

using namespace test;
using Catch::Matchers::Contains;
namespace fs = std::filesystem;

constexpr double kUnits = 1000.0;

std::string number_text(std::size_t i, std::size_t digits) {
  const std::string number = std::to_string(i);
  return std::string(digits - std::min(digits, number.size()), '0') + number;
}

/// A row of 16 numbers.
std::string row_text(const io::RecordedPose& pose) {
  std::string text = matrix_text(pose);
  std::replace(text.begin(), text.end(), '\n', ' ');
  return text + "\n";
}

/// Writes the room's images as depth/PREFIX0.png and colour/PREFIX0.png.
void write_images(const std::string& depth, const std::string& colour, std::size_t digits, double units_per_m = kUnits) {
  fs::create_directories(fs::path(depth).parent_path());
  fs::create_directories(fs::path(colour).parent_path());
  for (std::size_t i = 0; i < room_frames().size(); ++i) {
    write_png(depth + number_text(i, digits) + ".png", depth_in_units(room_frames()[i].depth, units_per_m));
    write_png(colour + number_text(i, digits) + ".png", room_frames()[i].colour);
  }
}

/// Checks that a recording holds the room, and that nothing looks wrong with it.
void check_room(const std::string& name, const std::string& layout) {
  LoggingContext log;
  const auto recording = open_recording(name, log.context);
  CHECK_THAT(recording->facts().layout, Contains(layout));
  CHECK(log.warnings.empty());
  REQUIRE(recording->num_frames() == static_cast<int>(room_frames().size()));
  for (const int i : {0, 7, 13}) {
    const RgbdFrame& truth = room_frames()[static_cast<std::size_t>(i)];
    const RgbdFrame frame = recording->load(i);
    CHECK(describe_frame_error(frame.view()).empty());
    CHECK(frame.depth(80, 60) == Approx(truth.depth(80, 60)).margin(1e-3));
    CHECK(frame.colour(80, 60).g == truth.colour(80, 60).g);
    CHECK(frame.calibration.depth.fx == Approx(truth.calibration.depth.fx));
    REQUIRE(frame.world_from_camera.has_value());
    CHECK(is_near(*frame.world_from_camera, *truth.world_from_camera, 1e-3F, 0.05F));
  }
}

bool has_depth(const RgbdFrame& frame) { return std::any_of(frame.depth.data(), frame.depth.data() + frame.depth.size(), is_valid_depth); }

template <class T>
void put(std::string& bytes, const T& value) {
  bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
}

void put_matrix(std::string& bytes, const Eigen::Matrix4f& matrix) {
  for (int row = 0; row < 4; ++row) {
    for (int column = 0; column < 4; ++column) put(bytes, matrix(row, column));
  }
}

std::string deflated(const Image<std::uint16_t>& image) {
  uLongf size = compressBound(static_cast<uLong>(2 * image.size()));
  std::string bytes(size, '\0');
  compress(reinterpret_cast<Bytef*>(bytes.data()), &size, reinterpret_cast<const Bytef*>(image.data()),
           static_cast<uLong>(2 * image.size()));
  bytes.resize(size);
  return bytes;
}

/// The room as a .sens file; `lost` marks the pose of a frame, -1 none.
std::string sens_bytes(const std::string& scratch, int lost = -1) {
  const Intrinsics& k = room_frames().front().calibration.depth;
  Eigen::Matrix4f camera = Eigen::Matrix4f::Identity();
  camera(0, 0) = k.fx;
  camera(1, 1) = k.fy;
  camera(0, 2) = k.cx;
  camera(1, 2) = k.cy;
  std::string bytes;
  put(bytes, std::uint32_t{4});
  put(bytes, std::uint64_t{4});
  bytes += "room";
  for (int i = 0; i < 2; ++i) {
    put_matrix(bytes, camera);
    put_matrix(bytes, Eigen::Matrix4f::Identity());
  }
  put(bytes, std::int32_t{1});  // PNG
  put(bytes, std::int32_t{1});  // deflated
  for (int i = 0; i < 2; ++i) {
    put(bytes, std::uint32_t{160});
    put(bytes, std::uint32_t{120});
  }
  put(bytes, 1000.0F);
  put(bytes, std::uint64_t{room_frames().size()});
  for (std::size_t i = 0; i < room_frames().size(); ++i) {
    const RgbdFrame& frame = room_frames()[i];
    Eigen::Matrix4f pose = Eigen::Matrix4f::Identity();
    pose.topLeftCorner<3, 3>() = frame.world_from_camera->rotation;
    pose.topRightCorner<3, 1>() = frame.world_from_camera->translation;
    if (static_cast<int>(i) == lost) pose.setConstant(-std::numeric_limits<float>::infinity());
    put_matrix(bytes, pose);
    for (int j = 0; j < 2; ++j) put(bytes, std::uint64_t{33333} * (i + 1));
    write_png(scratch, frame.colour);
    const std::string colour = read_text(scratch);
    const std::string depth = deflated(depth_in_units(frame.depth, kUnits));
    put(bytes, std::uint64_t{colour.size()});
    put(bytes, std::uint64_t{depth.size()});
    bytes += colour + depth;
  }
  fs::remove(scratch);
  return bytes;
}

}  // namespace

TEST_CASE("open_sequence: reads ScanNet's exported folders") {
  const TempFolder temp;
  write_images(temp / "depth/", temp / "color/", 1);
  fs::create_directories(temp / "pose");
  fs::create_directories(temp / "intrinsic");
  for (std::size_t i = 0; i < room_frames().size(); ++i) {
    write_text(temp / ("pose/" + std::to_string(i) + ".txt"), matrix_text(pose_of(room_frames()[i])));
  }
  write_text(temp / "intrinsic/intrinsic_depth.txt", room_intrinsics_text());
  write_text(temp / "intrinsic/intrinsic_color.txt", room_intrinsics_text());
  for (const char* name : {"extrinsic_depth", "extrinsic_color"}) {
    write_text(temp / ("intrinsic/" + std::string(name) + ".txt"), "1 0 0 0.1\n0 1 0 0\n0 0 1 0\n0 0 0 1\n");
  }
  check_room(temp.path(), "ScanNet");
  write_text(temp / "pose/3.txt", "-inf -inf -inf -inf\n-inf -inf -inf -inf\n-inf -inf -inf -inf\n-inf -inf -inf -inf\n");
  CHECK_FALSE(open_sequence(temp.path(), Context())->load(3).world_from_camera.has_value());
  fs::remove(temp / "color/5.png");
  LoggingContext log;
  CHECK(open_sequence(temp.path(), log.context)->num_frames() == 13);
  CHECK_THAT(log.warnings, Contains("1 images left out"));
}

TEST_CASE("open_sequence: images of a kind that is not read are told") {
  const TempFolder temp;
  write_images(temp / "depth/", temp / "rgb/", 1);
  for (std::size_t i = 0; i < room_frames().size(); ++i) {
    const std::string stem = temp / ("depth/" + std::to_string(i));
    fs::rename(stem + ".png", stem + ".exr");
  }
  CHECK_THAT(error_of([&] { open_sequence(temp.path(), Context()); }), Contains("depth image, a PNG or PGM of 16 bits"));
}

TEST_CASE("open_sequence: reads .sens files, by themselves or in their folder") {
  const TempFolder temp;
  write_text(temp / "scene.sens", sens_bytes(temp / "scratch.png", 4));
  LoggingContext log;
  CHECK_FALSE(open_sequence(temp / "scene.sens", log.context)->load(4).world_from_camera.has_value());
  CHECK_THAT(log.warnings, Contains("1 of its 14 frames have no pose"));
  write_text(temp / "scene.sens", sens_bytes(temp / "scratch.png"));
  check_room(temp / "scene.sens", "ScanNet");
  check_room(temp.path(), "ScanNet");
  CHECK(open_sequence(temp.path(), Context())->load(2).timestamp_s == Approx(3 * 0.033333));
}

TEST_CASE("open_sequence: a damaged .sens file is named, with what is missing") {
  const TempFolder temp;
  const std::string whole = sens_bytes(temp / "scratch.png");
  const auto error = [&](const std::string& bytes) {
    write_text(temp / "scene.sens", bytes);
    return error_of([&] { open_sequence(temp / "scene.sens", Context())->load(0); });
  };
  CHECK_THAT(error(whole.substr(0, 3)), Contains("scene.sens") && Contains("cut short"));
  CHECK_THAT(error(whole.substr(0, 100)), Contains("cut short before the colour camera"));
  CHECK_THAT(error(whole.substr(0, whole.size() / 3)), Contains("cut short"));
  CHECK_THAT(error("\x05" + whole.substr(1)), Contains("version 5"));
  std::string coded = whole;
  coded[4 + 8 + 4 + 256 + 4] = 2;  // the coding of depth
  CHECK_THAT(error(coded), Contains("depth of coding 2"));
  std::string damaged = whole;
  damaged[damaged.size() - 100] ^= 0x55;
  write_text(temp / "scene.sens", damaged);
  LoggingContext log;
  CHECK_FALSE(has_depth(open_sequence(temp / "scene.sens", log.context)->load(13)));
  CHECK_THAT(log.warnings, Contains("scene.sens") && Contains("damaged image") && Contains("without depth"));
}

TEST_CASE("open_sequence: of a .sens file that is cut short, the frames before are read") {
  const TempFolder temp;
  const std::string whole = sens_bytes(temp / "scratch.png");
  write_text(temp / "scene.sens", whole.substr(0, whole.size() - 1));
  LoggingContext log;
  CHECK(open_sequence(temp / "scene.sens", log.context)->num_frames() == 13);
  CHECK_THAT(log.warnings, Contains("cut short in an image") && Contains("first 13 of its 14 frames"));
}

TEST_CASE("open_sequence: reads Redwood's and Open3D's folders, their poses as a log") {
  const TempFolder temp;
  write_images(temp / "depth/", temp / "image/", 6);
  std::string log;
  for (std::size_t i = 0; i < room_frames().size(); ++i) {
    log += std::to_string(i) + "\t" + std::to_string(i) + "\t" + std::to_string(i + 1) + "\n" + matrix_text(pose_of(room_frames()[i]));
  }
  write_text(temp / GENERATE(as<std::string>{}, "camera.log", "trajectory.log", "livingroom.log"), log);
  const Intrinsics& k = room_frames().front().calibration.depth;
  std::ostringstream json;
  json << "{\"width\": 160, \"height\": 120, \"intrinsic_matrix\": [" << k.fx << ", 0, 0, 0, " << k.fy << ", 0, " << k.cx << ", " << k.cy
       << ", 1]}";
  write_text(temp / "camera_intrinsic.json", json.str());
  check_room(temp.path(), "numbered images");
}

TEST_CASE("open_sequence: Redwood's names may hold times") {
  const TempFolder temp;
  fs::create_directories(temp / "depth");
  fs::create_directories(temp / "rgb");
  for (std::size_t i = 0; i < 2; ++i) {
    write_png(temp / ("depth/" + number_text(i + 1, 6) + "-" + number_text(33369 * i, 12) + ".png"),
              depth_in_units(room_frames()[i].depth, kUnits));
    write_png(temp / ("rgb/" + number_text(i + 1, 6) + "-" + number_text(33400 * i, 12) + ".png"), room_frames()[i].colour);
  }
  write_text(temp / "camera-intrinsics.txt", room_intrinsics_text());
  CHECK(open_sequence(temp.path(), Context())->load(1).timestamp_s == Approx(0.033369));
}

TEST_CASE("open_sequence: reads Replica as NICE-SLAM renders it, its camera one level up") {
  const TempFolder temp;
  const std::string folder = temp / "room0";
  write_images(folder + "/results/depth", folder + "/results/frame", 6, 6553.5);
  std::string rows;
  for (const RgbdFrame& frame : room_frames()) rows += row_text(pose_of(frame));
  write_text(folder + "/traj.txt", rows);
  const Intrinsics& k = room_frames().front().calibration.depth;
  std::ostringstream json;
  json << "{\"camera\": {\"w\": 160, \"h\": 120, \"fx\": " << k.fx << ", \"fy\": " << k.fy << ", \"cx\": " << k.cx << ", \"cy\": " << k.cy
       << ", \"scale\": 6553.5}}";
  write_text(temp / "cam_params.json", json.str());
  check_room(folder, "Replica");

  truncate_file(folder + "/results/frame000004.png", 0.5);
  fs::remove(folder + "/results/depth000000.png");
  fs::remove(folder + "/results/depth000006.png");
  LoggingContext log;
  const auto sequence = open_sequence(folder, log.context);
  REQUIRE(sequence->num_frames() == 12);
  CHECK_FALSE(has_depth(sequence->load(3)));
  CHECK_THAT(log.warnings, Contains("2 images left out") && Contains("1 of its 12 frames cannot be read") && Contains("frame000004.png"));
  for (const auto& [place, number] : {std::pair<int, std::size_t>{0, 1}, {4, 5}, {5, 7}, {11, 13}}) {  // poses stay with their images
    CHECK(is_near(*sequence->load(place).world_from_camera, *room_frames()[number].world_from_camera, 1e-3F, 0.05F));
  }
}

TEST_CASE("open_sequence: reads Stray Scanner's export, whose camera is that of its larger colour images") {
  const TempFolder temp;
  write_images(temp / "depth/", temp / "rgb/", 6);
  std::string rows = "timestamp, frame, x, y, z, qx, qy, qz, qw\n";
  for (std::size_t i = 0; i < room_frames().size(); ++i) {
    const io::RecordedPose pose = pose_of(room_frames()[i]);
    const Eigen::Quaterniond q(pose.rotation);
    std::ostringstream row;
    row << 100.0 + 0.1 * static_cast<double>(i) << ", " << number_text(i, 6);
    for (const double x : {pose.translation_m.x(), pose.translation_m.y(), pose.translation_m.z(), q.x(), q.y(), q.z(), q.w()})
      row << ", " << x;
    rows += row.str() + "\n";
  }
  write_text(temp / "odometry.csv", rows);
  write_text(temp / "camera_matrix.csv", "146.25, 0.0, 79.625\n0.0, 146.25, 59.625\n0.0, 0.0, 1.0\n");
  check_room(temp.path(), "Stray Scanner");
  CHECK(open_sequence(temp.path(), Context())->load(3).timestamp_s == Approx(100.3));

  for (std::size_t i = 0; i < room_frames().size(); ++i) {
    Image<Rgb8> large(640, 480);
    for (int v = 0; v < 480; ++v) {
      for (int u = 0; u < 640; ++u) large(u, v) = room_frames()[i].colour(u / 4, v / 4);
    }
    write_png(temp / ("rgb/" + number_text(i, 6) + ".png"), large);
  }
  write_text(temp / "camera_matrix.csv", "585, 0.0, 320\n0.0, 585, 240\n0.0, 0.0, 1.0\n");
  check_room(temp.path(), "Stray Scanner");
  fs::remove_all(temp / "rgb");
  write_text(temp / "rgb.mp4", "");
  CHECK_THAT(error_of([&] { open_sequence(temp.path(), Context()); }), Contains("rgb.mp4") && Contains("ffmpeg"));
}

TEST_CASE("open_sequence: reads OpenLORIS and Bonn, which are TUM's layout with other names and cameras") {
  const TempFolder temp;
  SECTION("OpenLORIS") {
    write_room_as_tum(temp.path(), {});
    std::string depth = read_text(temp / "depth.txt");
    fs::remove(temp / "depth.txt");
    fs::rename(temp / "depth", temp / "aligned_depth");
    for (std::size_t at = depth.find("depth/"); at != std::string::npos; at = depth.find("depth/", at + 15)) depth.insert(at, "aligned_");
    write_text(temp / "aligned_depth.txt", depth);
    fs::rename(temp / "rgb.txt", temp / "color.txt");
    check_room(temp.path(), "TUM");
  }
  SECTION("Bonn") {
    const std::string folder = temp / "rgbd_bonn_balloon";
    RoomFormat format;
    format.intrinsics_file.clear();
    write_room_as_tum(folder, format);
    for (const auto& [place, is_depth] : {std::pair{"/depth/", true}, {"/rgb/", false}}) {
      const std::string file = folder + place + "0000.png";
      is_depth ? write_png(file, Image<std::uint16_t>(640, 480, 9000)) : write_png(file, Image<Rgb8>(640, 480));
    }
    const auto recording = open_recording(folder, Context());
    CHECK(recording->facts().calibration.depth.fx == 542.822841F);
    CHECK_THAT(recording->facts().depth_distortion, Contains("Brown-Conrady 0.039903"));
  }
}

TEST_CASE("open_sequence: reads BundleFusion's and 12-Scenes' folders by their info.txt") {
  const TempFolder temp;
  const std::string folder = temp / "data";
  RoomFormat format;
  format.intrinsics_file.clear();
  write_room_as_seven_scenes(folder, format);
  const Intrinsics& k = room_frames().front().calibration.depth;
  std::ostringstream info;
  info << "m_versionNumber = 4\nm_sensorName = StructureSensor\nm_colorWidth = 160\nm_colorHeight = 120\nm_depthWidth = 160\nm_depthHeight "
          "= 120\n"
       << "m_depthShift = 1000\n";
  for (const char* name : {"Color", "Depth"}) {
    info << "m_calibration" << name << "Intrinsic = " << k.fx << " 0 " << k.cx << " 0 0 " << k.fy << " " << k.cy << " 0 0 0 1 0 0 0 0 1 \n"
         << "m_calibration" << name << "Extrinsic = 1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1 \n";
  }
  write_text(temp / GENERATE(as<std::string>{}, "info.txt", "data/info.txt", "data/_info.txt"), info.str());
  check_room(folder, "7-Scenes");
}

TEST_CASE("parse_pose_list: rows, logs, lost poses, and a bad line is named") {
  const std::string identity = "1 0 0 0 0 1 0 0 0 0 1 0";
  CHECK(io::parse_pose_list(identity + "\n" + identity + " 0 0 0 1\n", "t.txt").size() == 2);
  CHECK_FALSE(io::parse_pose_list("nan 0 0 0 0 1 0 0 0 0 1 0\n", "t.txt").at(0).has_value());
  CHECK(io::parse_pose_list("7 7 8\n1 0 0 0\n0 1 0 0\n0 0 1 0\n0 0 0 1\n", "t.log").count(7) == 1);
  const auto error = [](const std::string& text) { return error_of([&] { io::parse_pose_list(text, "t.txt"); }); };
  CHECK_THAT(error("# nothing\n"), Contains("no pose"));
  CHECK_THAT(error(identity + "\n1 2 3 4\n"), Contains("4 numbers in line 2"));
  CHECK_THAT(error("0 0 1\n1 0 0 0\n0 1 0 0\n"), Contains("line 1") && Contains("four lines"));
  CHECK_THAT(error("0 0 1\n1 0 0 0\n0 1 0 0\n0 0 1 0\n0 0 0 1\n-1 0 0\n"), Contains("line 6"));
}

TEST_CASE("parse_odometry: a bad row is named") {
  const auto error = [](const std::string& text) { return error_of([&] { io::parse_odometry(text, "odometry.csv"); }); };
  CHECK_THAT(error("1 0 0 0\n"), Contains("4 columns in line 1"));
  CHECK_THAT(error("1 x 0 0 0 0 0 0 1\n"), Contains("'x'") && Contains("line 1"));
  CHECK_THAT(error("1 -5 0 0 0 0 0 0 1\n"), Contains("'-5'"));
  CHECK_FALSE(io::parse_odometry("1 0 nan 0 0 0 0 0 1\n", "odometry.csv").front().pose.has_value());
}

TEST_CASE("open_sequence: a folder of another kind is answered with what is in it, and with what is known") {
  const TempFolder temp;
  write_text(temp / "rosbag.bag", "");
  fs::create_directories(temp / "frames");
  CHECK_THAT(error_of([&] { open_sequence(temp.path(), Context()); }),
             Contains("frames/, rosbag.bag") && Contains("7-Scenes") && Contains("ScanNet") && Contains("Replica") && Contains("traj.txt"));
}

}  // namespace foothold

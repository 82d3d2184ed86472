// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// Exports of Record3D, and the EXR images in them: each test writes its recording and reads it back.
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <limits>
#include <sstream>

#include "exr_header.h"
#include "exr_image.h"
#include "foothold/io/image_file.h"
#include "io_fixtures.h"
#include "room_recording.h"
#include "support/catch.h"

#ifdef FOOTHOLD_HAS_EXR
#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfOutputFile.h>
#include <OpenEXR/ImfTiledOutputFile.h>
#endif

namespace foothold {
namespace {

using namespace test;
using Catch::Matchers::Contains;
namespace fs = std::filesystem;

/// The head of an EXR image: what can be told without OpenEXR.
struct HandMadeExr {
  std::uint32_t version = 2;
  std::int32_t window[4] = {0, 0, 2, 1};
  std::vector<std::string> channels = {"R"};
  std::int32_t pixel_type = 2;
  std::int32_t sampling = 1;
  char compression = 0;

  std::string bytes() const {
    std::string list;
    for (const std::string& channel : channels) {
      list += channel + '\0' + ints({pixel_type, 0, sampling, sampling});
    }
    std::string text = "\x76\x2f\x31\x01" + ints({static_cast<std::int32_t>(version)});
    text += attribute("channels", "chlist", list + '\0') + attribute("compression", "compression", {compression});
    return text + attribute("dataWindow", "box2i", ints({window[0], window[1], window[2], window[3]})) + '\0';
  }

 private:
  static std::string ints(const std::vector<std::int32_t>& numbers) {
    return {reinterpret_cast<const char*>(numbers.data()), sizeof(std::int32_t) * numbers.size()};
  }
  static std::string attribute(const std::string& name, const std::string& type, const std::string& value) {
    return name + '\0' + type + '\0' + ints({static_cast<std::int32_t>(value.size())}) + value;
  }
};

std::string header_error(const std::string& bytes) {
  return error_of([&] { io::parse_exr_header(bytes, "0.exr"); });
}

}  // namespace

TEST_CASE("parse_exr_header: tells size, channel and chunks before memory is taken") {
  HandMadeExr exr;
  exr.channels = {"A", "Z"};
  exr.compression = 3;
  exr.window[0] = -5;
  exr.window[3] = 40;
  const std::string bytes = exr.bytes();
  const io::ExrHeader header = io::parse_exr_header(bytes + "what follows", "0.exr");
  CHECK(header.size == io::ImageSize{8, 41});
  CHECK(header.channel == "Z");
  CHECK(header.num_bytes == bytes.size());
  CHECK(header.num_chunks == 3);  // of 16 lines
}

TEST_CASE("parse_exr_header: refuses what is not depth in scan lines, and sizes that no depth camera has") {
  const auto error = [](auto&& change) {
    HandMadeExr exr;
    change(exr);
    return header_error(exr.bytes());
  };
  CHECK_THAT(error([](HandMadeExr& exr) { exr.version |= 0x200U; }), Contains("in tiles") && Contains("expected scan lines"));
  CHECK_THAT(error([](HandMadeExr& exr) { exr.version |= 0x800U; }), Contains("deep"));
  CHECK_THAT(error([](HandMadeExr& exr) { exr.version |= 0x1000U; }), Contains("several parts"));
  CHECK_THAT(error([](HandMadeExr& exr) { exr.window[2] = std::numeric_limits<std::int32_t>::max(); }),
             Contains("0.exr") && Contains("8192 a side"));
  CHECK_THAT(error([](HandMadeExr& exr) { exr.window[2] = exr.window[3] = 8000; }), Contains("8001x8001 pixels"));
  CHECK_THAT(error([](HandMadeExr& exr) { exr.window[2] = -1; }), Contains("damaged header"));
  CHECK_THAT(error([](HandMadeExr& exr) { exr.channels = {"B", "G"}; }), Contains("2 channels") && Contains("Z, depth, Y or R"));
  CHECK_THAT(error([](HandMadeExr& exr) { exr.channels.clear(); }), Contains("0 channels"));
  CHECK_THAT(error([](HandMadeExr& exr) { exr.channels.assign(1000, "R"); }), Contains("1000 channels"));
  CHECK_THAT(error([](HandMadeExr& exr) { exr.pixel_type = 0; }), Contains("floating-point depth"));
  CHECK_THAT(error([](HandMadeExr& exr) { exr.sampling = 2; }), Contains("part of the pixels"));
  CHECK_THAT(error([](HandMadeExr& exr) { exr.compression = 8; }), Contains("compression 8"));
  CHECK_THAT(header_error("\x89PNG"), Contains("signature"));
  const std::string whole = HandMadeExr().bytes();
  for (std::size_t length = 0; length < whole.size(); ++length) CHECK_FALSE(header_error(whole.substr(0, length)).empty());
}

TEST_CASE("open_sequence: Record3D's own archive is refused, with the export that is read") {
  const TempFolder temp;
  write_text(temp / "room.r3d", "PK");
  CHECK_THAT(error_of([&] { open_sequence(temp / "room.r3d", Context()); }), Contains("room.r3d") && Contains("export as EXR + RGB"));
  fs::create_directories(temp / "unpacked/rgbd");
  write_text(temp / "unpacked/metadata", "{}");
  CHECK_THAT(error_of([&] { open_sequence(temp / "unpacked", Context()); }), Contains("unpacked: got Record3D's own archive"));
}

#ifdef FOOTHOLD_HAS_EXR

namespace {

void write_exr(const std::string& path, const Image<float>& image, Imf::Compression compression = Imf::ZIP_COMPRESSION) {
  Imf::Header header(image.width(), image.height());
  header.compression() = compression;
  header.channels().insert("R", Imf::Channel(Imf::FLOAT));
  Imf::FrameBuffer buffer;
  buffer.insert("R", Imf::Slice::Make(Imf::FLOAT, image.data(), header.dataWindow()));
  Imf::OutputFile file(path.c_str(), header, 0);
  file.setFrameBuffer(buffer);
  file.writePixels(image.height());
}

/// Every pixel of an image twice in both directions.
Image<Rgb8> doubled(const Image<Rgb8>& image) {
  Image<Rgb8> result(2 * image.width(), 2 * image.height());
  for (int v = 0; v < result.height(); ++v) {
    for (int u = 0; u < result.width(); ++u) result(u, v) = image(u / 2, v / 2);
  }
  return result;
}

/// What the app writes of the room: poses in OpenGL's axes relative to the first frame, and the intrinsics of its colour images.
std::string metadata_of_room() {
  std::ostringstream text;
  text.precision(12);
  const Intrinsics& k = room_frames().front().calibration.depth;
  text << "{\"h\":240,\"w\":320,\"fps\":30,\"K\":[" << 2 * k.fx << ",0,0,0," << 2 * k.fy << ",0," << 2 * k.cx + 0.5F << ","
       << 2 * k.cy + 0.5F << ",1],\"frameTimestamps\":[";
  const auto num_frames = room_frames().size();
  for (std::size_t i = 0; i < num_frames; ++i) text << (i == 0 ? "" : ",") << 100.0 + 0.05 * static_cast<double>(i);
  text << "],\"initPose\":[0,0,0,1,0,0,0],\"poses\":[";
  for (std::size_t i = 0; i < num_frames; ++i) {
    const io::RecordedPose pose = pose_of(room_frames()[i]);
    const Eigen::Quaterniond q(pose.rotation * Eigen::Vector3d(1.0, -1.0, -1.0).asDiagonal());
    const Eigen::Vector3d& t = pose.translation_m;
    text << (i == 0 ? "[" : ",[") << q.x() << "," << q.y() << "," << q.z() << "," << q.w() << "," << t.x() << "," << t.y() << "," << t.z()
         << "]";
  }
  return text.str() + "]}";
}

void write_room_as_record3d(const std::string& folder, const std::string& metadata_folder) {
  fs::create_directories(folder + "/depth");
  fs::create_directories(folder + "/rgb");
  for (std::size_t i = 0; i < room_frames().size(); ++i) {
    const RgbdFrame& frame = room_frames()[i];
    Image<float> depth = frame.depth;
    for (float& z : Span<float>(depth.data(), depth.size())) z = z > 0.0F ? z : std::numeric_limits<float>::quiet_NaN();
    write_exr(folder + "/depth/" + std::to_string(i) + ".exr", depth);
    write_png(folder + "/rgb/" + std::to_string(i) + ".png", doubled(frame.colour));
  }
  write_text(metadata_folder + "/metadata.json", metadata_of_room());
}

bool same(const Image<float>& a, const Image<float>& b) {
  return a.width() == b.width() && a.height() == b.height() && std::equal(a.data(), a.data() + a.size(), b.data());
}

bool has_depth(const RgbdFrame& frame) {
  const Span<const float> depth(frame.depth.data(), frame.depth.size());
  return std::any_of(depth.begin(), depth.end(), is_valid_depth);
}

}  // namespace

TEST_CASE("open_sequence: reads Record3D's export, wherever its folders lie") {
  const TempFolder temp;
  const auto [images, metadata, name] = GENERATE(table<std::string, std::string, std::string>(
      {{"EXR_RGBD", ".", "."}, {"EXR_RGBD", "EXR_RGBD", "."}, {".", ".", "."}, {"EXR_RGBD", ".", "EXR_RGBD"}}));
  write_room_as_record3d(temp / images, temp / metadata);
  LoggingContext log;
  const auto recording = open_recording(temp / name, log.context);
  CHECK(log.warnings.empty());
  CHECK_THAT(log.messages, Contains("Record3D, 14 frames of 160x120") && Contains("metadata.json, resized from 320x240") &&
                               Contains("depth in metres") && Contains("poses read as opengl"));
  const RecordingFacts& facts = recording->facts();
  CHECK(facts.colour_width == 320);
  CHECK(facts.depth_is_continuous);
  REQUIRE(recording->num_frames() == 14);
  for (const int i : {0, 7, 13}) {
    const RgbdFrame& truth = room_frames()[static_cast<std::size_t>(i)];
    const RgbdFrame frame = recording->load(i);
    CHECK(describe_frame_error(frame.view()).empty());
    CHECK(same(frame.depth, truth.depth));
    CHECK(frame.colour(80, 60).g == truth.colour(80, 60).g);
    CHECK(frame.calibration.depth.fx == Approx(truth.calibration.depth.fx));
    CHECK(frame.calibration.depth.cx == Approx(truth.calibration.depth.cx));
    CHECK(frame.timestamp_s == Approx(100.0 + 0.05 * i));
    REQUIRE(frame.world_from_camera.has_value());
    CHECK(is_near(*frame.world_from_camera, *truth.world_from_camera, 1e-4F, 0.01F));
  }
}

TEST_CASE("open_sequence: of a Record3D export that has damaged images, the others are read") {
  const TempFolder temp;
  write_room_as_record3d(temp.path(), temp.path());
  truncate_file(temp / "depth/5.exr", 0.1);
  truncate_file(temp / "depth/9.exr", 0.99);
  LoggingContext log;
  const auto sequence = open_sequence(temp.path(), log.context);
  CHECK_THAT(log.warnings, Contains("1 of its 14 frames cannot be read") && Contains("5.exr") && Contains("cut short"));
  CHECK(has_depth(sequence->load(4)));
  CHECK_FALSE(has_depth(sequence->load(5)));
  CHECK_FALSE(has_depth(sequence->load(9)));
  CHECK_THAT(log.warnings, Contains("9.exr") && Contains("without depth"));
  write_exr(temp / "depth/3.exr", Image<float>(80, 60));
  CHECK_THAT(error_of([&] { sequence->load(3); }), Contains("3.exr: got 80x60 pixels, expected 160x120"));
}

TEST_CASE("open_sequence: Record3D's front camera has no poses") {
  const TempFolder temp;
  write_room_as_record3d(temp.path(), temp.path());
  const std::string whole = metadata_of_room();
  std::string identities;
  for (std::size_t i = 0; i < room_frames().size(); ++i) identities += std::string(i == 0 ? "" : ",") + "[0,0,0,1,0,0,0]";
  write_text(temp / "metadata.json", whole.substr(0, whole.find("\"poses\"")) + "\"poses\":[" + identities + "]}");
  LoggingContext log;
  CHECK_FALSE(open_sequence(temp.path(), log.context)->load(3).world_from_camera.has_value());
  CHECK_THAT(log.warnings, Contains("all 14 poses are the identity"));
}

TEST_CASE("open_sequence: intrinsics that differ much between frames of Record3D are told") {
  const TempFolder temp;
  write_room_as_record3d(temp.path(), temp.path());
  const Intrinsics& k = room_frames().front().calibration.depth;
  std::ostringstream rows;
  for (int i = 0; i < 3; ++i) {
    rows << (i == 0 ? "" : ",") << "[" << 2 * k.fx << "," << 2 * k.fy << "," << 2 * k.cx + 0.5F << "," << 2 * k.cy + (i == 2 ? 20.5F : 0.5F)
         << "]";
  }
  const std::string whole = metadata_of_room();
  write_text(temp / "metadata.json", "{\"perFrameIntrinsicCoeffs\":[" + rows.str() + "]," + whole.substr(1));
  LoggingContext log;
  CHECK(open_sequence(temp.path(), log.context)->load(0).calibration.depth.cy == Approx(k.cy));
  CHECK_THAT(log.messages, Contains("metadata.json, the median of all frames"));
  CHECK_THAT(log.warnings, Contains("differ between frames by up to 6 %"));
}

TEST_CASE("decode_exr: reads every compression without loss, and keeps what is no number") {
  const TempFolder temp;
  Image<float> image(37, 70);
  for (std::size_t i = 0; i < image.size(); ++i) image.data()[i] = 0.001F * static_cast<float>(i) + 0.0003F;
  image(3, 4) = std::numeric_limits<float>::infinity();
  for (const Imf::Compression compression :
       {Imf::NO_COMPRESSION, Imf::RLE_COMPRESSION, Imf::ZIPS_COMPRESSION, Imf::ZIP_COMPRESSION, Imf::PIZ_COMPRESSION}) {
    write_exr(temp / "0.exr", image, compression);
    CHECK(same(io::decode_exr(read_text(temp / "0.exr"), "0.exr"), image));
    io::check_exr_file(temp / "0.exr");
    truncate_file(temp / "0.exr", 0.2);
    CHECK_THAT(error_of([&] { io::check_exr_file(temp / "0.exr"); }), Contains("cut short"));
    CHECK_THAT(error_of([&] { io::decode_exr(read_text(temp / "0.exr"), "0.exr"); }), Contains("0.exr"));
  }
}

TEST_CASE("decode_exr: a second header within an attribute is not understood") {
  const TempFolder temp;
  const Image<float> image(8, 6, 1.5F);
  write_exr(temp / "0.exr", image, Imf::NO_COMPRESSION);
  const std::string bytes = read_text(temp / "0.exr");
  HandMadeExr huge;
  huge.window[2] = huge.window[3] = 1 << 30;
  const std::string other = huge.bytes().substr(8);  // OpenEXR reads 16 bytes of a displayWindow, and this as the next attributes
  const auto size = static_cast<std::int32_t>(16 + other.size() - 1);
  std::string attribute("displayWindow\0box2i\0", 20);
  attribute += std::string(reinterpret_cast<const char*>(&size), sizeof size) + std::string(16, '\0') + other.substr(0, other.size() - 1);
  const std::size_t header_size = io::parse_exr_header(bytes, "0.exr").num_bytes;
  std::string hostile = bytes.substr(0, 8) + attribute + bytes.substr(8, header_size - 8);
  for (std::size_t i = 0; i < 6; ++i) {
    std::uint64_t place = 0;
    std::memcpy(&place, bytes.data() + header_size + 8 * i, sizeof place);
    place += attribute.size();
    hostile.append(reinterpret_cast<const char*>(&place), sizeof place);
  }
  hostile += bytes.substr(header_size + 48);
  CHECK(same(io::decode_exr(hostile, "0.exr"), image));
}

TEST_CASE("decode_exr: refuses tiles as OpenEXR writes them") {
  const TempFolder temp;
  Imf::Header header(32, 32);
  header.channels().insert("R", Imf::Channel(Imf::FLOAT));
  header.setTileDescription(Imf::TileDescription(16, 16));
  const Image<float> image(32, 32);
  Imf::FrameBuffer buffer;
  buffer.insert("R", Imf::Slice::Make(Imf::FLOAT, image.data(), header.dataWindow()));
  {
    Imf::TiledOutputFile file((temp / "0.exr").c_str(), header, 0);
    file.setFrameBuffer(buffer);
    file.writeTiles(0, 1, 0, 1);
  }
  CHECK_THAT(error_of([&] { io::decode_exr(read_text(temp / "0.exr"), "0.exr"); }), Contains("in tiles"));
}

#endif

}  // namespace foothold

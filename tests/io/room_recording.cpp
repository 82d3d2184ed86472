// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "room_recording.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <sstream>

#include "foothold/io/image_file.h"
#include "foothold/io/sequence.h"
#include "io_fixtures.h"

namespace foothold::test {
namespace {

constexpr int kNumFrames = 14;
constexpr int kStride = 3;  ///< so that the camera moves by some decimetres

std::string numbered(const char* format, std::size_t i) {
  std::array<char, 64> text{};
  std::snprintf(text.data(), text.size(), format, static_cast<int>(i));
  return text.data();
}

std::string time_text(double time) {
  std::array<char, 64> text{};
  std::snprintf(text.data(), text.size(), "%.3f", time);
  return text.data();
}

}  // namespace

const std::vector<RgbdFrame>& room_frames() {
  static const std::vector<RgbdFrame> frames = [] {
    std::vector<RgbdFrame> result;
    const auto sequence = open_sequence("synthetic:kitchen?frames=300&width=160&height=120", Context());
    for (int i = 0; i < kNumFrames; ++i) result.push_back(sequence->load(kStride * i));
    return result;
  }();
  return frames;
}

Image<std::uint16_t> depth_in_units(const Image<float>& depth_m, double units_per_m) {
  Image<std::uint16_t> image(depth_m.width(), depth_m.height());
  std::transform(depth_m.data(), depth_m.data() + depth_m.size(), image.data(), [&](float z) {
    return is_valid_depth(z) ? static_cast<std::uint16_t>(std::min(65534.0, std::round(static_cast<double>(z) * units_per_m)))
                             : std::uint16_t{0};
  });
  return image;
}

std::string matrix_text(const io::RecordedPose& pose) {
  std::ostringstream text;
  text.precision(12);
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) text << pose.rotation(row, column) << " ";
    text << pose.translation_m(row) << "\n";
  }
  text << "0 0 0 1\n";
  return text.str();
}

io::RecordedPose pose_of(const RgbdFrame& frame) {
  return {frame.world_from_camera->rotation.cast<double>(), frame.world_from_camera->translation.cast<double>()};
}

std::string room_intrinsics_text() {
  const Intrinsics& k = room_frames().front().calibration.depth;
  std::ostringstream text;
  text << k.fx << " 0 " << k.cx << "\n0 " << k.fy << " " << k.cy << "\n0 0 1\n";
  return text.str();
}

void write_room_as_seven_scenes(const std::string& folder, const RoomFormat& format) {
  std::filesystem::create_directories(folder);
  const std::vector<RgbdFrame>& frames = room_frames();
  for (std::size_t i = 0; i < frames.size(); ++i) {
    const std::string stem = folder + numbered("/frame-%06d", i);
    write_png(stem + ".color.png", frames[i].colour);
    write_png(stem + ".depth.png", depth_in_units(frames[i].depth, format.units_per_m));
    write_text(stem + ".pose.txt", matrix_text(format.pose(pose_of(frames[i]))));
  }
  if (!format.intrinsics_file.empty()) write_text(folder + "/" + format.intrinsics_file, room_intrinsics_text());
}

void write_room_as_tum(const std::string& folder, const RoomFormat& format, double s_per_unit, bool w_first) {
  std::filesystem::create_directories(folder + "/rgb");
  std::filesystem::create_directories(folder + "/depth");
  const std::vector<RgbdFrame>& frames = room_frames();
  std::ostringstream colour_list, depth_list, truth;
  truth.precision(12);
  for (std::size_t i = 0; i < frames.size(); ++i) {
    const std::string name = numbered("%04d.png", i);
    write_png(folder + "/rgb/" + name, frames[i].colour);
    write_png(folder + "/depth/" + name, depth_in_units(frames[i].depth, format.units_per_m));
    const double time_s = 1403636579.0 + static_cast<double>(i) / 30.0;
    colour_list << time_text((time_s + 0.004) / s_per_unit) << " rgb/" << name << "\n";
    depth_list << time_text(time_s / s_per_unit) << " depth/" << name << "\n";
    const io::RecordedPose pose = format.pose(pose_of(frames[i]));
    const Eigen::Quaterniond q(pose.rotation);
    truth << time_text(time_s / s_per_unit) << " " << pose.translation_m.transpose() << " ";
    if (w_first) truth << q.w() << " ";
    truth << q.x() << " " << q.y() << " " << q.z();
    if (!w_first) truth << " " << q.w();
    truth << "\n";
  }
  write_text(folder + "/rgb.txt", "# colour\n" + colour_list.str());
  write_text(folder + "/depth.txt", "# depth\n" + depth_list.str());
  write_text(folder + "/groundtruth.txt", truth.str());
  if (!format.intrinsics_file.empty()) write_text(folder + "/" + format.intrinsics_file, room_intrinsics_text());
}

}  // namespace foothold::test

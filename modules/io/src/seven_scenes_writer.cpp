// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "foothold/io/seven_scenes_writer.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <filesystem>

#include "foothold/base/atomic_file.h"
#include "foothold/base/contract.h"
#include "foothold/base/error.h"
#include "foothold/base/number_text.h"
#include "foothold/io/image_file.h"
#include "seven_scenes_sequence.h"

namespace foothold {
namespace {

std::string number_text(float value) { return general_text(value, 9); }

std::string transform_text(const SE3& transform) {
  std::string text;
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) text += number_text(transform.rotation(row, column)) + " ";
    text += number_text(transform.translation(row)) + "\n";
  }
  return text + "0 0 0 1\n";
}

std::string intrinsics_text(const Intrinsics& k) {
  return number_text(k.fx) + " 0 " + number_text(k.cx) + "\n0 " + number_text(k.fy) + " " + number_text(k.cy) + "\n0 0 1\n";
}

std::uint16_t in_millimetres(float depth_m) {
  const float millimetres = is_valid_depth(depth_m) ? std::round(depth_m * 1000.0F) : 0.0F;
  return millimetres < 65535.0F ? static_cast<std::uint16_t>(millimetres) : std::uint16_t{0};  // 65535 means invalid
}

Image<std::uint16_t> depth_in_millimetres(const Image<float>& depth_m) {
  Image<std::uint16_t> result(depth_m.width(), depth_m.height());
  std::transform(depth_m.data(), depth_m.data() + depth_m.size(), result.data(), in_millimetres);
  return result;
}

/// What is wrong with a frame besides a colour image of another size.
std::string describe_error_but_size(const RgbdFrame& frame) {
  Frame view = frame.view();
  if (frame.colour.empty()) return describe_frame_error(view);
  view.colour.width = view.depth.width;
  view.colour.height = view.depth.height;
  return describe_frame_error(view);
}

}  // namespace

void round_depth_as_recorded(Image<float>& depth_m) {
  std::transform(depth_m.data(), depth_m.data() + depth_m.size(), depth_m.data(),
                 [](float z) { return static_cast<float>(in_millimetres(z)) / 1000.0F; });
}

SevenScenesWriter::SevenScenesWriter(const std::string& folder) : folder_(folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (!std::filesystem::is_directory(folder)) {
    throw FileError(folder + ": cannot be created: " + (error ? error.message() : "a file of this name is in the way"));
  }
  if (io::looks_like_seven_scenes(folder)) {
    throw FileError(folder + ": got a folder that holds frames already, expected a new or empty one");
  }
}

void SevenScenesWriter::write(const RgbdFrame& frame) {
  FOOTHOLD_EXPECTS_NO_ERROR(describe_error_but_size(frame));
  if (num_frames() == 0) {
    width_ = frame.depth.width();
    height_ = frame.depth.height();
    colour_width_ = frame.colour.width();
    colour_height_ = frame.colour.height();
    has_poses_ = frame.world_from_camera.has_value();
    calibration_ = frame.calibration;
    write_calibration();
  }
  FOOTHOLD_EXPECTS(frame.depth.width() == width_ && frame.depth.height() == height_);
  FOOTHOLD_EXPECTS(frame.colour.width() == colour_width_ && frame.colour.height() == colour_height_);
  FOOTHOLD_EXPECTS(frame.world_from_camera.has_value() == has_poses_);
  FOOTHOLD_EXPECTS(same_calibration(frame.calibration, calibration_));

  std::array<char, 32> stem{};
  std::snprintf(stem.data(), stem.size(), "frame-%06d", num_frames());
  try {
    write_files(path(stem.data()), frame);
  } catch (...) {  // memory that ran out, too
    // What was recorded before, say until the disk was full, shall stay a valid recording.
    std::error_code ignored;
    for (const char* suffix : {".color.png", ".depth.png", ".pose.txt"}) std::filesystem::remove(path(stem.data()) + suffix, ignored);
    throw;
  }
  times_s_.push_back(frame.timestamp_s);
}

void SevenScenesWriter::write_files(const std::string& stem, const RgbdFrame& frame) const {
  write_png(stem + ".color.png", frame.colour);
  write_png(stem + ".depth.png", depth_in_millimetres(frame.depth));
  if (has_poses_) write_file_atomically(stem + ".pose.txt", transform_text(*frame.world_from_camera), Durability::kCrash);
}

void SevenScenesWriter::finish() {
  AtomicFile file(path("timestamps.txt"));
  for (std::size_t i = 0; i < times_s_.size(); ++i) file.stream() << std::to_string(i) + " " + fixed_text(times_s_[i], 6) + "\n";
  file.commit();
}

void SevenScenesWriter::write_calibration() const {
  write_file_atomically(path("camera-intrinsics.txt"), intrinsics_text(calibration_.depth));
  write_file_atomically(path("colour-intrinsics.txt"), intrinsics_text(calibration_.colour));
  write_file_atomically(path("depth-from-colour.txt"), transform_text(calibration_.depth_from_colour));
  write_file_atomically(path("depth-scale.txt"), "1000\n");
}

std::string SevenScenesWriter::path(const std::string& name) const { return (std::filesystem::path(folder_) / name).string(); }

}  // namespace foothold

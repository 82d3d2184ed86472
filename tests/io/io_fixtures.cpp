// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "io_fixtures.h"

#include <cmath>
#include <filesystem>
#include <iterator>

#include "foothold/io/sequence.h"
#include "foothold/io/seven_scenes_writer.h"

namespace foothold::test {

namespace fs = std::filesystem;

void truncate_file(const std::string& path, double fraction) {
  fs::resize_file(path, static_cast<std::uintmax_t>(fraction * static_cast<double>(fs::file_size(path))));
}

std::string reading_error(const std::string& folder) {
  return error_of([&] {
    const auto sequence = open_sequence(folder, Context());
    for (int i = 0; i < sequence->num_frames(); ++i) sequence->load(i);
  });
}

RgbdFrame small_frame(int i) {
  RgbdFrame frame;
  frame.depth = Image<float>(kTestWidth, kTestHeight);
  frame.colour = Image<Rgb8>(kTestWidth, kTestHeight);
  for (int v = 0; v < kTestHeight; ++v) {
    for (int u = 0; u < kTestWidth; ++u) {
      frame.depth(u, v) = u == 0 ? 0.0F : static_cast<float>(1000 + 40 * v + u + i) / 1000.0F;
      frame.colour(u, v) = {static_cast<std::uint8_t>(8 * u), static_cast<std::uint8_t>(10 * v), static_cast<std::uint8_t>(i)};
    }
  }
  frame.calibration.depth = {40.0F, 41.5F, 15.5F, 11.25F};
  frame.calibration.colour = frame.calibration.depth;
  frame.index = i;
  frame.timestamp_s = 100.0 + 0.04 * i;
  Tangent6 tangent;
  tangent << 0.1F, -0.2F, 0.01F * static_cast<float>(i), 1.0F, 2.0F, 0.05F * static_cast<float>(i);
  frame.world_from_camera = se3_exp(tangent);
  return frame;
}

void write_small_recording(const std::string& folder, int num_frames) {
  SevenScenesWriter writer(folder);
  for (int i = 0; i < num_frames; ++i) writer.write(small_frame(i));
  writer.finish();
}

}  // namespace foothold::test

// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "foothold/api/raw_sequence.h"

#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <limits>
#include <string>

#include "foothold/base/error.h"
#include "support/catch.h"
#include "support/error_message.h"
#include "support/random_seed.h"

namespace foothold {
namespace {

/// A file that is deleted behind the test.
struct TempFile {
  TempFile() {
    Random random = test::test_random();
    path = (std::filesystem::temp_directory_path() / ("foothold_raw_" + std::to_string(random.bits()) + std::to_string(random.bits())))
               .string();
  }
  ~TempFile() { std::remove(path.c_str()); }
  std::string path;
};

RgbdFrame make_frame(Random& random, int i) {
  RgbdFrame frame;
  frame.depth = Image<float>(7, 5);
  frame.colour = Image<Rgb8>(7, 5);
  for (std::size_t k = 0; k < frame.depth.size(); ++k) {
    frame.depth.data()[k] = static_cast<float>(random.below(13000)) / 1000.0F;
    frame.colour.data()[k] = {static_cast<std::uint8_t>(random.below(256)), static_cast<std::uint8_t>(k), 7};
  }
  frame.calibration.depth = {585.0F, 584.0F, 3.5F, 2.5F};
  frame.calibration.colour = {525.0F, 524.0F, 3.25F, 2.25F};
  frame.calibration.depth_from_colour.translation = {0.025F, -0.001F, 0.002F};
  frame.index = 10 + i;
  frame.timestamp_s = 1.5 * i;
  if (i != 1) {
    Tangent6 tangent;
    for (int k = 0; k < 6; ++k) tangent[k] = random.uniform(-1.0F, 1.0F);
    frame.world_from_camera = se3_exp(tangent);
  }
  return frame;
}

void write(const std::string& path, const std::vector<RgbdFrame>& frames) {
  std::ofstream stream(path, std::ios::binary);
  RawSequenceWriter writer(stream);
  for (const RgbdFrame& frame : frames) writer.write(frame);
  writer.finish();
}

TEST_CASE("raw recording: what was written comes back, depth to a tenth of a millimetre") {
  const TempFile file;
  Random random = test::test_random();
  std::vector<RgbdFrame> frames;
  for (int i = 0; i < 3; ++i) frames.push_back(make_frame(random, i));
  write(file.path, frames);
  REQUIRE(is_raw_sequence(file.path));
  const auto sequence = open_raw_sequence(file.path);
  REQUIRE(sequence->num_frames() == 3);
  for (const int i : {2, 0, 1}) {
    const RgbdFrame& expected = frames[static_cast<std::size_t>(i)];
    const RgbdFrame actual = sequence->load(i);
    REQUIRE(actual.index == expected.index);
    REQUIRE(actual.timestamp_s == expected.timestamp_s);
    REQUIRE(actual.calibration.depth.fy == 584.0F);
    REQUIRE(actual.calibration.colour.cx == 3.25F);
    REQUIRE(actual.calibration.depth_from_colour.translation.x() == 0.025F);
    REQUIRE(actual.world_from_camera.has_value() == (i != 1));
    if (i != 1) REQUIRE(actual.world_from_camera->rotation == expected.world_from_camera->rotation);
    for (std::size_t k = 0; k < expected.depth.size(); ++k) {
      REQUIRE(std::abs(actual.depth.data()[k] - expected.depth.data()[k]) < 1e-6F);  // whole millimetres survive
      REQUIRE(actual.colour.data()[k].r == expected.colour.data()[k].r);
      REQUIRE(actual.colour.data()[k].g == expected.colour.data()[k].g);
    }
  }
}

TEST_CASE("raw recording: no measurement and too far both read zero") {
  const TempFile file;
  Random random = test::test_random();
  RgbdFrame frame = make_frame(random, 0);
  const float odd[] = {-1.0F, 0.0F, std::numeric_limits<float>::quiet_NaN(), 13.2F, std::numeric_limits<float>::infinity(), 13.0F};
  for (std::size_t k = 0; k < 6; ++k) frame.depth.data()[k] = odd[k];
  write(file.path, {frame});
  const RgbdFrame actual = open_raw_sequence(file.path)->load(0);
  for (std::size_t k = 0; k < 5; ++k) REQUIRE(actual.depth.data()[k] == 0.0F);
  REQUIRE(actual.depth.data()[5] == 13.0F);
}

TEST_CASE("raw recording: refuses what is missing, unfinished or damaged, naming the file") {
  const TempFile file;
  const auto message = [&] { return test::error_message<FileError>([&] { open_raw_sequence(file.path); }); };
  REQUIRE(test::contains(message(), file.path));
  REQUIRE_FALSE(is_raw_sequence(file.path));
  Random random = test::test_random();
  {
    std::ofstream stream(file.path, std::ios::binary);
    RawSequenceWriter writer(stream);
    writer.write(make_frame(random, 0));
  }
  REQUIRE(test::contains(message(), "unfinished"));

  write(file.path, {make_frame(random, 0)});
  std::ifstream in(file.path, std::ios::binary);
  const std::string good((std::istreambuf_iterator<char>(in)), {});
  const auto with = [&](std::size_t at, const std::string& bytes) {
    std::string damaged = good;
    damaged.replace(at, bytes.size(), bytes);
    std::ofstream(file.path, std::ios::binary) << damaged;
    return message();
  };
  REQUIRE(test::contains(with(8, "\2"), "version 2"));
  REQUIRE(test::contains(with(12, std::string(4, '\xff')), "-1 frames"));
  REQUIRE(test::contains(with(12, "\2"), "bytes"));
  REQUIRE(test::contains(with(16, std::string(4, '\x7f')), "pixels"));
  REQUIRE(test::contains(with(24, std::string(4, '\0')), "calibration"));
  std::ofstream(file.path, std::ios::binary) << good.substr(0, good.size() - 1);
  REQUIRE(test::contains(message(), "bytes"));
}

}  // namespace
}  // namespace foothold

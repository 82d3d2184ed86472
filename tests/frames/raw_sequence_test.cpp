// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "foothold/frames/raw_sequence.h"

#include <cmath>
#include <fstream>
#include <limits>
#include <string>

#include "foothold/base/error.h"
#include "support/catch.h"
#include "support/error_message.h"
#include "support/mend_checksums.h"
#include "support/random_seed.h"
#include "support/temp_folder.h"

namespace foothold {
namespace {

/// A file that is deleted behind the test.
struct TempFile {
  test::TempFolder folder;
  std::string path = folder / "recording.raw";
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

  write(file.path, {make_frame(random, 0), make_frame(random, 2)});
  const std::string good = test::read_text(file.path);
  for (std::size_t length = 0; length < good.size(); ++length) {
    test::write_text(file.path, good.substr(0, length));
    REQUIRE(test::contains(message(), file.path));
  }
  test::write_text(file.path, good + "x");
  REQUIRE(test::contains(message(), "unfinished or damaged"));
  const auto with = [&](std::size_t place, const std::string& bytes) {
    std::string damaged = good;
    damaged.replace(place, bytes.size(), bytes);
    std::size_t begin = 0;
    test::mend_checksums(damaged, begin);
    test::write_text(file.path, damaged);
    return message();
  };
  REQUIRE(test::contains(with(8, "\1"), "version 1, expected version 2"));
  REQUIRE(test::contains(with(16, std::string(4, '\x7f')), "pixels"));
  REQUIRE(test::contains(with(24, std::string(4, '\0')), "calibration"));
  REQUIRE(test::contains(with(24 + 32, std::string(4, '\x7f')), "not rigid"));
}

TEST_CASE("raw recording: a damaged byte is noticed when its frame is loaded, and spares the others") {
  const TempFile file;
  Random random = test::test_random();
  write(file.path, {make_frame(random, 0), make_frame(random, 1), make_frame(random, 2)});
  std::string bytes = test::read_text(file.path);
  bytes[bytes.size() / 2] = static_cast<char>(bytes[bytes.size() / 2] ^ 1);
  test::write_text(file.path, bytes);
  const auto sequence = open_raw_sequence(file.path);
  REQUIRE_NOTHROW(sequence->load(0));
  REQUIRE(test::contains(test::error_message<FileError>([&] { sequence->load(1); }), file.path + ": frame 1: damaged"));
  REQUIRE_NOTHROW(sequence->load(2));
}

}  // namespace
}  // namespace foothold

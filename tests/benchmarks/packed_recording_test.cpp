// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "packed_recording.h"

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <sstream>

#include "foothold/base/error.h"
#include "foothold/base/random.h"
#include "foothold/synthetic/synthetic_sequence.h"
#include "range_coder.h"
#include "support/catch.h"
#include "support/error_message.h"
#include "support/random_seed.h"
#include "support/temp_folder.h"

namespace foothold::benchmark {
namespace {

TEST_CASE("range coder: gives back every whole number, however unlikely") {
  Random random = test::test_random();
  std::vector<int> values = {0, 1, -1, 14, 15, -15, 16, 65535, -65535, (1 << 24) - 1, -(1 << 24) + 1};
  for (int i = 0; i < 5000; ++i) {
    const auto size = static_cast<unsigned>(random.below(25));
    values.push_back(static_cast<int>(random.bits() & ((1U << size) - 1U)) * (random.below(2) == 0 ? 1 : -1));
  }
  BitEncoder encoder;
  NumberModel writing;
  for (int value : values) writing.code(encoder, value);
  const std::vector<std::uint8_t> bytes = encoder.finish();
  BitDecoder decoder(bytes.data(), bytes.data() + bytes.size());
  NumberModel reading;
  for (const int expected : values) {
    int value = 0;
    reading.code(decoder, value);
    REQUIRE(value == expected);
  }
}

/// A room whose depth has holes, seen twice.
std::unique_ptr<Sequence> room() {
  return make_synthetic_sequence(parse_synthetic_spec("synthetic:office?frames=2&width=96&height=64"), Context{});
}

TEST_CASE("packed recording: depth is kept to half a millimetre, colour to half a step, and poses as they are") {
  const test::TempFolder folder;
  const std::string path = folder / "room";
  const std::unique_ptr<Sequence> expected = room();
  {
    std::ofstream stream(path, std::ios::binary);
    pack_recording(*expected, 1000, stream);
  }
  REQUIRE(is_packed_recording(path));
  const std::unique_ptr<Sequence> actual = open_packed_recording(path);
  REQUIRE(actual->num_frames() == 2);
  for (int i = 0; i < 2; ++i) {
    const RgbdFrame before = expected->load(i);
    const RgbdFrame after = actual->load(i);
    REQUIRE(after.index == before.index);
    REQUIRE(same_calibration(after.calibration, before.calibration));
    REQUIRE(after.world_from_camera->translation == before.world_from_camera->translation);
    REQUIRE(after.depth.size() == before.depth.size());
    for (std::size_t k = 0; k < before.depth.size(); ++k) {
      const float depth_m = is_valid_depth(before.depth.data()[k]) ? before.depth.data()[k] : 0.0F;
      REQUIRE(std::abs(after.depth.data()[k] - depth_m) <= 0.501e-3F);
      REQUIRE(std::abs(after.colour.data()[k].r - before.colour.data()[k].r) <= 4);
      REQUIRE(std::abs(after.colour.data()[k].g - before.colour.data()[k].g) <= 4);
      REQUIRE(std::abs(after.colour.data()[k].b - before.colour.data()[k].b) <= 4);
    }
  }
}

TEST_CASE("packed recording: other files and shortened ones are refused by name") {
  const test::TempFolder folder;
  const std::string path = folder / "room";
  std::ostringstream stream;
  pack_recording(*room(), 2, stream);
  const std::string bytes = stream.str();
  for (const std::size_t size : {std::size_t{0}, std::size_t{50}, std::size_t{200}, bytes.size() - 1}) {
    std::ofstream(path, std::ios::binary) << bytes.substr(0, size);
    const std::string message = test::error_message<FileError>([&] {
      const std::unique_ptr<Sequence> sequence = open_packed_recording(path);
      for (int i = 0; i < sequence->num_frames(); ++i) sequence->load(i);
    });
    REQUIRE(test::contains(message, path));
  }
  REQUIRE_FALSE(is_packed_recording(folder / "missing"));
}

}  // namespace
}  // namespace foothold::benchmark

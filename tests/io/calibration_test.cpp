// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "foothold/io/calibration.h"

#include "io_fixtures.h"
#include "support/catch.h"

namespace foothold::test {
namespace {

TEST_CASE("read_calibration: reads the folder of a recording") {
  const TempFolder folder;
  write_small_recording(folder.path(), 1);
  const RgbdCalibration expected = small_frame(0).calibration;
  const RgbdCalibration actual = read_calibration(folder.path());
  CHECK(actual.depth.fx == Approx(expected.depth.fx));
  CHECK(actual.colour.cy == Approx(expected.colour.cy));
  CHECK(translation_distance_m(actual.depth_from_colour, expected.depth_from_colour) < 1e-6F);
}

TEST_CASE("read_calibration: insists on the depth camera's matrix") {
  const TempFolder folder;
  CHECK_THAT(error_of([&] { read_calibration(folder.path()); }), Catch::Matchers::Contains("camera-intrinsics.txt: missing"));
}

}  // namespace
}  // namespace foothold::test

// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "foothold/io/image_file.h"

#include <algorithm>
#include <limits>
#include <opencv2/imgcodecs.hpp>

#include "io_fixtures.h"
#include "support/catch.h"
#include "support/random_seed.h"

namespace foothold {

using namespace test;
using Catch::Matchers::Contains;

TEST_CASE("write_png: colour and 16-bit images read back exactly") {
  const TempFolder temp;
  Random random = test_random();
  Image<Rgb8> colour(17, 5);
  Image<std::uint16_t> depth(17, 5);
  const auto byte = [&] { return static_cast<std::uint8_t>(random.below(256)); };
  for (int v = 0; v < 5; ++v) {
    for (int u = 0; u < 17; ++u) {
      colour(u, v) = {byte(), byte(), byte()};
      depth(u, v) = static_cast<std::uint16_t>(random.below(65536));
    }
  }
  write_png(temp / "colour.png", colour);
  write_png(temp / "depth.png", depth);
  const Image<Rgb8> read_colour = read_rgb_image(temp / "colour.png");
  const Image<std::uint16_t> read_depth = read_u16_image(temp / "depth.png");
  REQUIRE(read_colour.width() == 17);
  REQUIRE(read_colour.height() == 5);
  for (std::size_t i = 0; i < colour.size(); ++i) {
    CHECK(read_colour.data()[i].r == colour.data()[i].r);
    CHECK(read_colour.data()[i].g == colour.data()[i].g);
    CHECK(read_colour.data()[i].b == colour.data()[i].b);
  }
  CHECK(std::equal(depth.data(), depth.data() + depth.size(), read_depth.data()));
}

TEST_CASE("read_rgb_image: reads JPEG, and notices one cut short") {
  const TempFolder temp;
  const std::string path = temp / "a.jpg";
  cv::imwrite(path, cv::Mat(48, 64, CV_8UC3, cv::Scalar(10, 100, 200)));  // blue, green, red
  const Image<Rgb8> image = read_rgb_image(path);
  CHECK(image.width() == 64);
  CHECK(std::abs(image(30, 30).r - 200) <= 3);
  CHECK(std::abs(image(30, 30).b - 10) <= 3);
  truncate_file(path, GENERATE(0.3, 0.7, 0.99));
  CHECK_THAT(error_of([&] { read_rgb_image(path); }), Contains(path) && Contains("JPEG image cut short"));
}

TEST_CASE("read_rgb_image: missing files, folders and empty images are named") {
  const TempFolder temp;
  CHECK_THAT(error_of([&] { read_rgb_image(temp / "absent.png"); }), Contains(temp / "absent.png") && Contains("no such file"));
  CHECK_THAT(error_of([&] { read_rgb_image(temp.path()); }), Contains(temp.path()) && Contains("a folder"));
  CHECK_THAT(error_of([&] { write_png(temp / "a.png", Image<Rgb8>()); }), Contains(temp / "a.png"));
  CHECK(temp.num_files() == 0);
}

TEST_CASE("read_rgb_image: reads a PGM with comments, and refuses one whose size two decoders may understand differently") {
  const TempFolder temp;
  write_text(temp / "good.pgm", std::string("P5 # made by hand\n3 # wide\n2\n255\n") + "abcdef");
  CHECK(read_rgb_image(temp / "good.pgm").width() == 3);
  for (const char* head : {"P5\n1# 2 2 \n1 1 ", "P5 1 1 255#\n", "P5 1 2/ 255\n"}) {
    write_text(temp / "bad.pgm", std::string(head) + std::string(8, '6'));
    CHECK_THAT(error_of([&] { read_rgb_image(temp / "bad.pgm"); }), Contains("a PGM or PPM image cut short or with a damaged header"));
  }
}

TEST_CASE("read_rgb_image: refuses a PGM without a blank behind its magic, which OpenCV would read as DICOM") {
  const TempFolder temp;
  std::string bytes = "P5#\n1 1 255\n" + std::string(256, 'a');
  bytes.replace(128, 4, "DICM");
  write_text(temp / "bad.pgm", bytes);
  CHECK_THAT(error_of([&] { read_rgb_image(temp / "bad.pgm"); }), Contains("a PGM or PPM image cut short or with a damaged header"));
}

TEST_CASE("colourise_depth: near is brighter than far, nothing is black") {
  Image<float> depth(4, 1);
  depth(0, 0) = 0.5F;
  depth(1, 0) = 4.5F;
  depth(2, 0) = -1.0F;
  depth(3, 0) = std::numeric_limits<float>::quiet_NaN();
  const Image<Rgb8> image = colourise_depth(depth);
  const auto brightness = [&](int u) { return image(u, 0).r + image(u, 0).g + image(u, 0).b; };
  CHECK(brightness(0) > brightness(1));
  CHECK(brightness(1) > 0);
  CHECK(brightness(2) == 0);
  CHECK(brightness(3) == 0);
  const TempFolder temp;
  write_png(temp / "depth.png", depth);
  CHECK(read_rgb_image(temp / "depth.png")(0, 0).g == image(0, 0).g);
}

}  // namespace foothold

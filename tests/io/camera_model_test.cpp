// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "camera_model.h"

#include "io_fixtures.h"
#include "support/catch.h"
#include "text_file.h"

namespace foothold::io {
namespace {

using Catch::Matchers::Contains;
using test::error_of;

void check_intrinsics(const Intrinsics& k) {
  CHECK(k.fx == 500.5F);
  CHECK(k.fy == 501.0F);
  CHECK(k.cx == 320.25F);
  CHECK(k.cy == 240.0F);
}

}  // namespace

TEST_CASE("parse_camera: reads every way in which people write intrinsics down") {
  const std::string text = GENERATE(
      as<std::string>{},  //
      "500.5 0 320.25\n0 501 240\n0 0 1\n", "500.5 0 320.25 0\n0 501 240 0\n0 0 1 0\n", "500.5 0 320.25 0\n0 501 240 0\n0 0 1 0\n0 0 0 1\n",
      "500.5 501 320.25 240", "# fx fy cx cy\n500.5 501 320.25 240\n", "[[500.5, 0, 320.25], [0, 501, 240], [0, 0, 1]]",
      "[500.5, 0, 320.25; 0, 501, 240; 0, 0, 1]", "500.5\t0\t320.25\n0\t501\t240\n0\t0\t1\n", "500,5\t501\t320,25\t240\n",
      "500.5 501 320.25 240 0 0 0 0 0", "500.5 501 320.25 240 640 480", "640 480 500.5 501 320.25 240",
      R"({"width": 640, "height": 480, "intrinsic_matrix": [500.5, 0, 0, 0, 501, 0, 320.25, 240, 1]})",
      R"({"camera": {"w": 640, "h": 480, "fx": 500.5, "fy": 501, "cx": 320.25, "cy": 240, "scale": 6553.5}})",
      R"({"K": [[500.5, 0, 320.25], [0, 501, 240], [0, 0, 1]]})", "fx = 500.5\nfy = 501\ncx = 320.25\ncy = 240\n",
      "%YAML:1.0\nCamera.fx: 500.5\nCamera.fy: 501\nCamera.cx: 320.25\nCamera.cy: 240\nCamera.width: 640\n",
      "%YAML:1.0\n---\ncamera_matrix: !!opencv-matrix\n  rows: 3\n  cols: 3\n  dt: d\n  data: [ 500.5, 0., 320.25, 0., 501., 240., "
      "0., 0., 1. ]\n",
      "cam0:\n  intrinsics: [500.5, 501, 320.25, 240]\n  resolution: [640, 480]\n",
      "image_width: 640\nimage_height: 480\nK: [500.5, 0.0, 320.25, 0.0, 501.0, 240.0, 0.0, 0.0, 1.0]\nD: [0, 0, 0, 0, 0]\n",
      "m_depthWidth = 640\nm_depthHeight = 480\nm_calibrationColorIntrinsic = 1 0 2 0 0 3 4 0 0 0 1 0 0 0 0 1\n"
      "m_calibrationDepthIntrinsic = 500.5 0 320.25 0 0 501 240 0 0 0 1 0 0 0 0 1\n");
  CAPTURE(text);
  const CameraFile content = parse_camera(plain_text(text), "k.txt");
  check_intrinsics(content.camera.intrinsics);
  CHECK_FALSE(content.camera.distortion.any());
  const ImageSize& size = content.camera.size;
  CHECK((size.empty() || size == ImageSize{640, 480}));
}

TEST_CASE("parse_camera: of two cameras in a file, each is told by the name above it") {
  const std::string colour =
      R"("color_intrinsics": {"width": 1280, "height": 720, "fx": 900, "fy": 901, "ppx": 640, "ppy": 360, "k1": 0.1})";
  const std::string depth = R"("depth_intrinsics": {"width": 640, "height": 480, "fx": 500.5, "fy": 501, "ppx": 320.25, "ppy": 240})";
  const std::string text = GENERATE_COPY(as<std::string>{}, "{" + colour + ",\n" + depth + "}", "{" + depth + ",\n" + colour + "}",
                                         "{\"name\": \"camera_color_frame\", " + depth + ",\n" + colour + "}");
  CAPTURE(text);
  const CameraFile of_depth = parse_camera(plain_text(text), "k.json");
  check_intrinsics(of_depth.camera.intrinsics);
  CHECK(of_depth.has_both);
  CHECK(of_depth.camera.size == ImageSize{640, 480});
  CHECK_FALSE(of_depth.camera.distortion.any());
  const CameraFile of_colour = parse_camera(plain_text(text), "k.json", CameraKind::kColour);
  CHECK(of_colour.camera.intrinsics.fy == 901.0F);
  CHECK(of_colour.camera.size == ImageSize{1280, 720});
  CHECK(of_colour.camera.distortion.any());
  CHECK_FALSE(parse_camera(R"({"frame": "camera_depth_frame", "fx": 5, "fy": 5, "cx": 3, "cy": 2})", "k.json").has_both);
}

TEST_CASE("parse_camera: takes distortion from behind the intrinsics, and from names") {
  const std::string text =
      GENERATE(as<std::string>{}, "500 501 320 240 0.1 -0.2 0.003 -0.004 0.5",
               "fx: 500\nfy: 501\ncx: 320\ncy: 240\nk1: 0.1\nk2: -0.2\np1: 0.003\np2: -0.004\nk3: 0.5\n",
               "K: [500, 0, 320, 0, 501, 240, 0, 0, 1]\ndistortion_model: plumb_bob\nD: [0.1, -0.2, 0.003, -0.004, 0.5]\n",
               "camera_matrix: !!opencv-matrix\n rows: 3\n cols: 3\n data: [500, 0, 320, 0, 501, 240, 0, 0, 1]\n"
               "distortion_coefficients: !!opencv-matrix\n rows: 1\n cols: 5\n data: [0.1, -0.2, 0.003, -0.004, 0.5]\n");
  CAPTURE(text);
  const Distortion distortion = parse_camera(text, "k.txt").camera.distortion;
  CHECK(distortion.model == Distortion::Model::kBrownConrady);
  CHECK(distortion.coefficients == std::array<double, 8>{0.1, -0.2, 0.003, -0.004, 0.5, 0.0, 0.0, 0.0});
  CHECK_THAT(to_string(distortion), Contains("Brown-Conrady 0.1 -0.2"));
}

TEST_CASE("parse_camera: knows fisheyes by their names") {
  const auto camera =
      parse_camera("fx: 500\nfy: 501\ncx: 320\ncy: 240\ndistortion_model: equidistant\nD: [0.1, 0.2, 0.3, 0.4]\n", "k.yaml").camera;
  CHECK(camera.distortion.model == Distortion::Model::kKannalaBrandt);
  CHECK(camera.distortion.coefficients[3] == 0.4);
  CHECK_THAT(error_of([] { parse_camera("model: inverse_brown_conrady\nfx: 5\ncx: 3\ncy: 2\nk1: 0.1", "k.yaml"); }), Contains("inverse"));
}

TEST_CASE("parse_camera: takes the unit of depth along, in units per metre or its inverse") {
  CHECK(parse_camera("fx: 5\ncx: 3\ncy: 2\nDepthMapFactor: 5000.0", "k.yaml").depth_units_per_m == 5000.0);
  CHECK(*parse_camera("fx: 5\ncx: 3\ncy: 2\ndepth_scale: 0.001", "k.yaml").depth_units_per_m == Approx(1000.0));
  CHECK_FALSE(parse_camera("fx: 5\ncx: 3\ncy: 2\nscale: 1.0", "k.yaml").depth_units_per_m.has_value());
}

TEST_CASE("parse_camera: what is no camera is named, with the value") {
  const auto error = [](const std::string& text) { return error_of([&] { parse_camera(text, "k.txt"); }); };
  CHECK_THAT(error(""), Contains("k.txt") && Contains("0 numbers"));
  CHECK_THAT(error("1 2 3"), Contains("3 numbers"));
  CHECK_THAT(error("500 x 320 240"), Contains("'x'"));
  CHECK_THAT(error("500 -501 320 240"), Contains("-501"));
  CHECK_THAT(error("500 501 1e9 240"), Contains("principal point"));
  CHECK_THAT(error("name: webcam"), Contains("fx, fy, cx and cy"));
  CHECK_THAT(error("500 501 320 240 0.1 1e9 0 0"), Contains("1e+09") || Contains("1000000000"));
}

TEST_CASE("describe_impossible: a principal point outside the image, or a focal length off by more than three times") {
  const ImageSize vga{640, 480};
  CHECK(describe_impossible({525.0F, 525.0F, 319.5F, 239.5F}, vga).empty());
  CHECK(describe_impossible({250.0F, 250.0F, 319.5F, 239.5F}, vga).empty());
  CHECK_THAT(describe_impossible({525.0F, 525.0F, 647.0F, 239.5F}, vga), Contains("647 239.5"));
  CHECK_THAT(describe_impossible({525.0F, 525.0F, 319.5F, -1.0F}, vga), Contains("principal point"));
  CHECK_THAT(describe_impossible({200.0F, 200.0F, 319.5F, 239.5F}, vga), Contains("focal lengths of 200 200"));
  CHECK_THAT(describe_impossible({525.0F, 525.0F, 79.5F, 59.5F}, {160, 120}), Contains("focal lengths of 525 525"));
  CHECK_THAT(describe_impossible({525.0F, 2000.0F, 319.5F, 239.5F}, vga), Contains("focal"));
}

TEST_CASE("resized: keeps pixel centres aligned") {
  const CameraModel half = resized({{525.0F, 525.0F, 319.5F, 239.5F}, {}, {640, 480}}, {320, 240});
  CHECK(half.intrinsics.fx == 262.5F);
  CHECK(half.intrinsics.cx == 159.5F);
  CHECK(half.intrinsics.cy == 119.5F);
}

}  // namespace foothold::io

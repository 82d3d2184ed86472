// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "record3d_metadata.h"

#include "support/catch.h"
#include "support/error_message.h"

namespace foothold::io {
namespace {

using Catch::Matchers::Contains;
using test::error_of;

Record3dMetadata parse(const std::string& text) { return parse_record3d_metadata(text, "metadata.json"); }

}  // namespace

TEST_CASE("parse_record3d_metadata: K is written column by column, and belongs to images of w x h") {
  const Record3dMetadata metadata = parse(R"({"h":960,"K":[700.5,0,0,0,701,0,361,482,1],"w":720,"fps":60})");
  REQUIRE(metadata.camera.has_value());
  const CameraModel& camera = *metadata.camera;
  CHECK(camera.intrinsics.fx == 700.5F);
  CHECK(camera.intrinsics.fy == 701.0F);
  CHECK(camera.intrinsics.cx == 361.0F);
  CHECK(camera.intrinsics.cy == 482.0F);
  CHECK(camera.size == ImageSize{720, 960});
  CHECK(metadata.frame_rate_hz == 60.0);
  CHECK_FALSE(metadata.is_median);
  CHECK(metadata.poses.empty());
  CHECK(parse(R"({"K": [700, 0, 361, 0, 701, 482, 0, 0, 1]})").camera->intrinsics.cx == 361.0F);  // rewritten row by row
}

TEST_CASE("parse_record3d_metadata: poses are qx qy qz qw and a position, and may be lost") {
  const Record3dMetadata metadata = parse(R"({"poses": [[0, 0, 0, 1, 1, 2, 3], [1,0,0,0,-4,5,6], [NaN,0,0,1,0,0,0],
      [null, null, null, null, null, null, null]], "initPose": [0,0,0,1,0,0,0], "cameraType": "a \"poses\" of # 1"})");
  REQUIRE(metadata.poses.size() == 4);
  CHECK(metadata.poses[0]->translation_m == Eigen::Vector3d(1.0, 2.0, 3.0));
  CHECK(metadata.poses[0]->rotation.isIdentity(1e-12));
  CHECK(metadata.poses[1]->rotation.isApprox(Eigen::Vector3d(1.0, -1.0, -1.0).asDiagonal().toDenseMatrix(), 1e-12));
  CHECK_FALSE(metadata.poses[2].has_value());
  CHECK_FALSE(metadata.poses[3].has_value());
}

TEST_CASE("parse_record3d_metadata: of intrinsics for each frame the median counts, and how far they differ is told") {
  const Record3dMetadata metadata = parse(R"({"w": 720, "h": 960, "K": [1,0,0,0,1,0,1,1,1],
      "perFrameIntrinsicCoeffs": [[700, 700, 360, 480], [710, 711, 365, 432], [705, 706, 361, 481]]})");
  CHECK(metadata.camera->intrinsics.fx == 705.0F);
  CHECK(metadata.camera->intrinsics.fy == 706.0F);
  CHECK(metadata.camera->intrinsics.cx == 361.0F);
  CHECK(metadata.camera->intrinsics.cy == 480.0F);
  CHECK(metadata.is_median);
  CHECK(metadata.variation == Approx(0.05));
}

TEST_CASE("parse_record3d_metadata: times that rise are kept") {
  CHECK(parse(R"({"frameTimestamps": [0.5, 0.517, 0.533]})").times_s == std::vector<double>{0.5, 0.517, 0.533});
  CHECK(parse(R"({"frameTimestamps": [0.5, 0.5, 0.533]})").times_s.empty());
  CHECK(parse(R"({"frameTimestamps": [0.5, null, 0.533]})").times_s.empty());
}

TEST_CASE("parse_record3d_metadata: what is missing or null stays empty") {
  for (const char* text : {"", "{}", R"({"poses": null, "K": null, "fps": null})", R"({"poses": [], "fps": -3, "w": 1e9})", "poses"}) {
    const Record3dMetadata metadata = parse(text);
    CHECK(metadata.poses.empty());
    CHECK_FALSE(metadata.camera.has_value());
    CHECK(metadata.frame_rate_hz == 0.0);
  }
}

TEST_CASE("parse_record3d_metadata: what is damaged is named") {
  const auto error = [](const std::string& text) { return error_of([&] { parse(text); }); };
  CHECK_THAT(error(R"({"poses": [[0,0,0,1,0,0,0], [0,0,0,1,0,0]]})"), Contains("metadata.json: got 6 numbers in row 1 of poses"));
  CHECK_THAT(error(R"({"poses": [[0,0,0,1,0,0,0], [0,0,0)"), Contains("cut short in poses"));
  CHECK_THAT(error(R"({"poses": [[0,0,0,2,0,0,0]]})"), Contains("row 0 of poses"));
  CHECK_THAT(error(R"({"poses": [["a"]]})"), Contains("among the numbers of poses"));
  CHECK_THAT(error(R"({"K": [1, 2, 3]})"), Contains("3 numbers in row 0 of K"));
  CHECK_THAT(error(R"({"K": [0,0,0,0,0,0,0,0,1]})"), Contains("focal length"));
  CHECK_THAT(error(R"({"K": [NaN,0,0,0,1,0,1,1,1]})"), Contains("the matrix K"));
}

}  // namespace foothold::io

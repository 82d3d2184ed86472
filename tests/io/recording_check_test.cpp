// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "foothold/io/recording_check.h"

#include <filesystem>

#include "foothold/io/image_file.h"
#include "io_fixtures.h"
#include "room_recording.h"
#include "support/catch.h"

namespace foothold {
namespace {

using namespace test;
using Catch::Matchers::Contains;
using io::RecordedPose;

/// What is warned of when a folder is opened.
std::string warnings_of(const std::string& folder, const SequenceOptions& options = {}) {
  LoggingContext log;
  open_sequence(folder, log.context, options);
  return log.warnings;
}

SequenceOptions with_scale(double units_per_m) {
  SequenceOptions options;
  options.depth_units_per_m = units_per_m;
  return options;
}

SequenceOptions with_convention(const std::string& words) {
  SequenceOptions options;
  options.pose_convention = words;
  return options;
}

}  // namespace

TEST_CASE("check_recording: says nothing against a recording that is as it should be") {
  const TempFolder temp;
  write_room_as_seven_scenes(temp.path());
  CHECK(warnings_of(temp.path()).empty());
  const RecordingCheck check = check_recording(*open_recording(temp.path(), Context()));
  CHECK(check.num_pose_pairs > 3);
  CHECK(check.pose_agreement > 0.8);
  CHECK(check.valid_fraction > 0.5);
  CHECK(check.median_depth_m > 0.5);
}

TEST_CASE("check_recording: depth in another unit is told by its median, or by poses, and the right unit is named") {
  const TempFolder temp;
  SECTION("TUM's layout in millimetres, where rooms look like dolls' houses") {
    write_room_as_tum(temp.path(), {});
    CHECK_THAT(warnings_of(temp.path()), Contains("unit of depth") && Contains("1/5000") && Contains("--depth-scale 1000"));
    CHECK(warnings_of(temp.path(), with_scale(1000.0)).empty());
  }
  SECTION("7-Scenes' layout in fifths of a millimetre") {
    RoomFormat format;
    format.units_per_m = 5000.0;
    write_room_as_seven_scenes(temp.path(), format);
    CHECK_THAT(warnings_of(temp.path()), Contains("unit of depth") && Contains("1/1000") && Contains("--depth-scale 5000"));
    write_text(temp / "depth-scale.txt", "5000\n");
    CHECK(warnings_of(temp.path()).empty());
  }
  SECTION("units not far from the layout's, which poses tell apart") {
    const double units = GENERATE(500.0, 2000.0, 4000.0, 8000.0, 256.0);
    CAPTURE(units);
    RoomFormat format;
    format.units_per_m = units;
    write_room_as_seven_scenes(temp.path(), format);
    CHECK_THAT(warnings_of(temp.path()),
               Contains("unit of depth") && Contains("--depth-scale " + std::to_string(static_cast<int>(units)) + " "));
    CHECK(warnings_of(temp.path(), with_scale(units)).empty());
    CHECK(warnings_of(temp.path(), with_scale(1.0 / units)).empty());  // metres per unit
  }
  SECTION("whole metres, which hold too little to tell anything else") {
    RoomFormat format;
    format.units_per_m = 1.0;
    write_room_as_seven_scenes(temp.path(), format);
    CHECK_THAT(warnings_of(temp.path(), with_scale(1.0)), Contains("steps of 1 m") && !Contains("--pose-convention"));
  }
  SECTION("whole metres") {
    RoomFormat format;
    format.units_per_m = 1.0;
    write_room_as_seven_scenes(temp.path(), format);
    CHECK_THAT(warnings_of(temp.path()), Contains("unit of depth") && Contains("--depth-scale 1 "));
  }
  SECTION("tenths of a millimetre, without poses") {
    RoomFormat format;
    format.units_per_m = 10000.0;
    write_room_as_seven_scenes(temp.path(), format);
    for (int i = 0; i < 14; ++i)
      std::filesystem::remove(temp / ("frame-0000" + std::string(i < 10 ? "0" : "") + std::to_string(i) + ".pose.txt"));
    CHECK_THAT(warnings_of(temp.path()), Contains("unit of depth") && Contains("median depth"));
  }
}

TEST_CASE("open_sequence: a depth scale that is given wins over the folder's, and must be a number of units") {
  const TempFolder temp;
  write_room_as_seven_scenes(temp.path());
  write_text(temp / "depth-scale.txt", "500\n");
  const float z = open_sequence(temp.path(), Context(), with_scale(1000.0))->load(0).depth(80, 60);
  CHECK(open_sequence(temp.path(), Context())->load(0).depth(80, 60) == Approx(2.0F * z));
  CHECK_THAT(error_of<InvalidSettings>([&] { open_sequence(temp.path(), Context(), with_scale(-3.0)); }), Contains("-3"));
  write_text(temp / "depth-scale.txt", "0\n");
  CHECK_THAT(error_of([&] { open_sequence(temp.path(), Context()); }), Contains("depth-scale.txt") && Contains("got 0"));
}

TEST_CASE("check_recording: poses of another convention are told by how they fit the depth, and the right one is named") {
  struct Case {
    std::string words;
    RecordedPose (*write)(const RecordedPose&);
  };
  const auto inverse = [](const RecordedPose& p) {
    return RecordedPose{p.rotation.transpose(), -(p.rotation.transpose() * p.translation_m)};
  };
  const Case c = GENERATE_COPY(values<Case>({
      {"inverse", inverse},
      {"opengl",
       [](const RecordedPose& p) {
         return RecordedPose{p.rotation * Eigen::Vector3d(1.0, -1.0, -1.0).asDiagonal(), p.translation_m};
       }},
      {"mm",
       [](const RecordedPose& p) {
         return RecordedPose{p.rotation, 1000.0 * p.translation_m};
       }},
      {"cm",
       [](const RecordedPose& p) {
         return RecordedPose{p.rotation, 100.0 * p.translation_m};
       }},
      {"ros",
       [](const RecordedPose& p) {
         Eigen::Matrix3d ours_from_ros;
         ours_from_ros << 0.0, -1.0, 0.0, 0.0, 0.0, -1.0, 1.0, 0.0, 0.0;
         return RecordedPose{p.rotation * ours_from_ros, p.translation_m};
       }},
      {"mirror-y",
       [](const RecordedPose& p) {
         const Eigen::Vector3d m(1.0, -1.0, 1.0);
         return RecordedPose{m.asDiagonal() * p.rotation * m.asDiagonal(), m.asDiagonal() * p.translation_m};
       }},
  }));
  CAPTURE(c.words);
  const TempFolder temp;
  RoomFormat format;
  format.pose = c.write;
  write_room_as_seven_scenes(temp.path(), format);
  // A camera that pans about its y axis moves alike in a world mirrored along y: nothing is to be seen, and little to be lost.
  if (c.words != "mirror-y") CHECK_THAT(warnings_of(temp.path()), Contains("--pose-convention " + c.words + "\n"));
  CHECK(warnings_of(temp.path(), with_convention(c.words)).empty());
  const SE3 read = *open_sequence(temp.path(), Context(), with_convention(c.words))->load(5).world_from_camera;
  CHECK(is_near(read, *room_frames()[5].world_from_camera, 1e-4F, 0.01F));
  write_text(temp / "pose-convention.txt", c.words + "\n");
  CHECK(warnings_of(temp.path()).empty());
}

TEST_CASE("check_recording: depth along rays, focal lengths a fifth too large and depth of an odd scale are told by name") {
  const TempFolder temp;
  write_room_as_seven_scenes(temp.path());
  SequenceOptions options;
  std::string expected;
  SECTION("rays") {
    expected = "along rays instead of the optical axis";
    const Intrinsics& k = room_frames().front().calibration.depth;
    for (std::size_t i = 0; i < room_frames().size(); ++i) {
      Image<float> rays = room_frames()[i].depth;
      for (int v = 0; v < rays.height(); ++v) {
        for (int u = 0; u < rays.width(); ++u) rays(u, v) *= k.back_project(static_cast<float>(u), static_cast<float>(v), 1.0F).norm();
      }
      write_png(temp / ("frame-0000" + std::string(i < 10 ? "0" : "") + std::to_string(i) + ".depth.png"), depth_in_units(rays, 1000.0));
    }
  }
  SECTION("intrinsics") {
    options.intrinsics = "180,180,79.625,59.625";
    expected = "with focal lengths of about 1";
  }
  SECTION("scale") {
    RoomFormat format;
    format.units_per_m = 1500.0;
    write_room_as_seven_scenes(temp.path(), format);
    expected = "with depth about 0.67 times as large";
  }
  CHECK_THAT(warnings_of(temp.path(), options), Contains("of the depth agrees between frames") && Contains(expected));
}

TEST_CASE("check_recording: positions in a unit that has no name here are doubted, and no other unit is advised") {
  const TempFolder temp;
  RoomFormat format;
  format.pose = [](const RecordedPose& p) { return RecordedPose{p.rotation, 10.0 * p.translation_m}; };
  write_room_as_seven_scenes(temp.path(), format);
  CHECK_THAT(warnings_of(temp.path()), Contains("may be wrong") && !Contains("--pose-convention"));
}

TEST_CASE("check_recording: a small thing seen from near is no wrong unit if its poses fit") {
  const TempFolder temp;
  RoomFormat format;
  format.units_per_m = 150.0;  // a seventh of the room's size
  format.pose = [](const RecordedPose& p) { return RecordedPose{p.rotation, 0.15 * p.translation_m}; };
  write_room_as_seven_scenes(temp.path(), format);
  CHECK_THAT(warnings_of(temp.path()), Contains("its poses fit") && !Contains("--depth-scale"));
}

TEST_CASE("check_recording: quaternions with w first are told, and read") {
  const TempFolder temp;
  RoomFormat format;
  format.units_per_m = 5000.0;
  write_room_as_tum(temp.path(), format, 1.0, true);
  CHECK_THAT(warnings_of(temp.path()), Contains("--pose-convention w-first\n"));
  CHECK(warnings_of(temp.path(), with_convention("w-first")).empty());
  const SE3 read = *open_sequence(temp.path(), Context(), with_convention("w-first"))->load(5).world_from_camera;
  CHECK(is_near(read, *room_frames()[5].world_from_camera, 1e-3F, 0.05F));
}

TEST_CASE("parse_pose_convention: combines words, and names an unknown one") {
  CHECK(to_string(io::parse_pose_convention("opengl,inverse")) == "inverse,opengl");
  CHECK(to_string(io::parse_pose_convention("")) == "as-is");
  CHECK_THAT(error_of<InvalidSettings>([] { io::parse_pose_convention("opengl,left"); }), Contains("'left'") && Contains("mirror-y"));
}

TEST_CASE("open_sequence: poses kilometres away are shown relative to the first, and what is added is told") {
  const TempFolder temp;
  RoomFormat format;
  format.pose = [](const RecordedPose& p) {
    return RecordedPose{p.rotation, p.translation_m + Eigen::Vector3d(481234.0, 5412345.0, 300.0)};
  };
  write_room_as_seven_scenes(temp.path(), format);
  const auto sequence = open_sequence(temp.path(), Context());
  CHECK(warnings_of(temp.path()).empty());
  for (const int i : {0, 13}) {
    const SE3 pose = *sequence->load(i).world_from_camera;
    CHECK(pose.translation.norm() < 10.0F);
    const Eigen::Vector3d restored = pose.translation.cast<double>() + sequence->origin_m() - Eigen::Vector3d(481234.0, 5412345.0, 300.0);
    CHECK((restored - room_frames()[static_cast<std::size_t>(i)].world_from_camera->translation.cast<double>()).norm() < 1e-4);
  }
  CHECK(open_sequence(temp.path() + "@3:9", Context())->origin_m() == sequence->origin_m());
}

}  // namespace foothold

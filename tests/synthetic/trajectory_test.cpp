// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "foothold/synthetic/trajectory.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "foothold/synthetic/renderer.h"
#include "scenes.h"
#include "support/catch.h"

namespace foothold {
namespace {

constexpr double kFrame_s = 1.0 / 30.0;
constexpr int kNumFrames = 900;
/// Hand-held motion: 7-Scenes' kitchen has at most 36 mm and 1.4 deg between frames.
constexpr float kLargestStep_m = 0.045F;
constexpr float kLargestTurn_rad = 3.0F * 0.017453293F;

std::vector<std::string> rooms() {
  std::vector<std::string> names = synthetic_room_names();
  for (int k = 0; k < 5; ++k) names.push_back("training-" + std::to_string(k));
  return names;
}

TEST_CASE("Trajectory: poses are rigid and neighbouring frames are near each other") {
  for (const std::string& name : rooms()) {
    const Room room = make_room(name);
    for (const TrajectoryKind kind : {TrajectoryKind::kTrain, TrajectoryKind::kTest}) {
      const Trajectory trajectory(room, kind, 42);
      SE3 before = trajectory.world_from_camera(0.0);
      for (int i = 1; i < kNumFrames; ++i) {
        const SE3 pose = trajectory.world_from_camera(i * kFrame_s);
        REQUIRE(is_rigid(pose, 1e-5F));
        REQUIRE(translation_distance_m(before, pose) < kLargestStep_m);
        REQUIRE(rotation_distance_rad(before, pose) < kLargestTurn_rad);
        before = pose;
      }
    }
  }
}

TEST_CASE("Trajectory: the camera is held upright and moves") {
  const Trajectory trajectory(make_room("office"), TrajectoryKind::kTrain, 42);
  Eigen::Vector3f low = trajectory.world_from_camera(0.0).translation;
  Eigen::Vector3f high = low;
  for (int i = 0; i < kNumFrames; i += 10) {
    const SE3 pose = trajectory.world_from_camera(i * kFrame_s);
    REQUIRE(pose.rotation(2, 1) < -0.5F);  // the image's y axis points down
    low = low.cwiseMin(pose.translation);
    high = high.cwiseMax(pose.translation);
  }
  REQUIRE((high - low).head<2>().norm() > 1.0F);
}

TEST_CASE("Trajectory: the camera stays clear of everything in the room") {
  for (const std::string& name : rooms()) {
    const Room room = make_room(name);
    for (const TrajectoryKind kind : {TrajectoryKind::kTrain, TrajectoryKind::kTest}) {
      const Trajectory trajectory(room, kind, 42);
      for (int i = 0; i < kNumFrames; i += 30) {
        INFO(name << ", frame " << i);
        const SE3 pose = trajectory.world_from_camera(i * kFrame_s);
        REQUIRE(distance_to_surface(room, pose.translation) > 0.3F);
        const RenderedView view = render(room, test::small_camera().scaled(0.25F), pose, 40, 30);
        const auto* begin = view.depth.data();
        const auto num_near = std::count_if(begin, begin + view.depth.size(), [](float z) { return z < 0.4F; });
        REQUIRE(num_near < 40 * 30 / 10);
      }
    }
  }
}

/// The share of pixels of a view whose surface points are seen from one of the other poses too.
double share_seen(const Room& room, const SE3& pose, const std::vector<SE3>& others, const std::vector<RenderedView>& views) {
  const Intrinsics camera = test::small_camera().scaled(0.25F);
  const RenderedView view = render(room, camera, pose, 40, 30);
  int num_seen = 0;
  for (int v = 0; v < 30; ++v) {
    for (int u = 0; u < 40; ++u) {
      const Eigen::Vector3f point = pose * camera.back_project(static_cast<float>(u), static_cast<float>(v), view.depth(u, v));
      for (std::size_t k = 0; k < others.size(); ++k) {
        const Eigen::Vector3f p = others[k].inverse() * point;
        if (p.z() < 0.1F) continue;
        const Eigen::Vector2f pixel = camera.project(p);
        const int x = static_cast<int>(std::lround(pixel.x()));
        const int y = static_cast<int>(std::lround(pixel.y()));
        if (!views[k].depth.view().contains(x, y) || std::fabs(views[k].depth(x, y) - p.z()) > 0.05F * p.z()) continue;
        ++num_seen;
        break;
      }
    }
  }
  return num_seen / (40.0 * 30.0);
}

TEST_CASE("Trajectory: test views show mapped surfaces from other places") {
  constexpr int kLength = 300;
  for (const std::string& name : synthetic_room_names()) {
    const Room room = make_room(name);
    const Trajectory train(room, TrajectoryKind::kTrain, 42);
    const Trajectory test(room, TrajectoryKind::kTest, 42);
    std::vector<SE3> poses;
    std::vector<RenderedView> views;
    for (int i = 0; i < kLength; i += 10) {
      poses.push_back(train.world_from_camera(i * kFrame_s));
      views.push_back(render(room, test::small_camera().scaled(0.25F), poses.back(), 40, 30));
    }
    double share = 0.0;
    int count = 0;
    int num_novel = 0;
    for (int i = 0; i < kLength; i += 20, ++count) {
      const SE3 pose = test.world_from_camera(i * kFrame_s);
      share += share_seen(room, pose, poses, views);
      const bool novel = std::all_of(poses.begin(), poses.end(), [&](const SE3& known) {
        return translation_distance_m(known, pose) > 0.1F || rotation_distance_rad(known, pose) > 0.17F;
      });
      num_novel += novel ? 1 : 0;
    }
    INFO(name);
    REQUIRE(share / count > 0.7);
    REQUIRE(num_novel > count / 2);
  }
}

TEST_CASE("Trajectory: seeds vary the tremor only, and equal arguments give equal paths") {
  const Room room = make_room("lounge");
  const Trajectory a(room, TrajectoryKind::kTest, 1);
  const Trajectory b(room, TrajectoryKind::kTest, 2);
  const Trajectory again(room, TrajectoryKind::kTest, 1);
  for (const double time_s : {0.0, 3.3, 12.0, 60.0}) {
    REQUIRE(translation_distance_m(a.world_from_camera(time_s), again.world_from_camera(time_s)) == 0.0F);
    const float apart_m = translation_distance_m(a.world_from_camera(time_s), b.world_from_camera(time_s));
    REQUIRE(apart_m > 0.0F);
    REQUIRE(apart_m < 0.02F);
  }
}

}  // namespace
}  // namespace foothold

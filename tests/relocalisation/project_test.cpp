// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "pose/project_kernels.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "foothold/base/exec/cpu_executor.h"
#include "pose/rejoin_kernels.h"
#include "relocalisation/averaged_camera.h"
#include "support/catch.h"
#include "support/random_motion.h"
#include "support/random_seed.h"

namespace foothold {
namespace {

using namespace test;

/// The depth at a pixel, from a camera that looks into a corner: two walls and a floor.
float corner_depth_m(int u, int v) {
  const float x = (static_cast<float>(u) - kCamera.cx) / kCamera.fx;
  const float y = (static_cast<float>(v) - kCamera.cy) / kCamera.fy;
  const float front = 3.0F / (1.0F + 0.5F * x);  // slanted
  const float side = x > 0.0F ? 0.7F / x : 1e9F;
  const float floor = y > 0.0F ? 0.5F / y : 1e9F;
  return std::min({front, side, floor});
}

std::vector<FeaturePixel> corner() {
  std::vector<FeaturePixel> pixels(static_cast<std::size_t>(kWidth * kHeight));
  for (int v = 0; v < kHeight; ++v) {
    for (int u = 0; u < kWidth; ++u) {
      pixels[static_cast<std::size_t>(v * kWidth + u)].channels[0] = static_cast<std::int16_t>(1000.0F * corner_depth_m(u, v) + 0.5F);
    }
  }
  return pixels;
}

RememberedPoint remembered(const Eigen::Vector3f& p) { return {{p.x(), p.y(), p.z()}, {100, 100, 100}, 1}; }

/// What a scene remembers of the corner as seen from a pose.
std::vector<RememberedPoint> points_of_corner(Random& random, int num_points, const SE3& scene_from_camera) {
  std::vector<RememberedPoint> points;
  for (int i = 0; i < num_points; ++i) {
    const auto u = static_cast<int>(random.below(kWidth));
    const auto v = static_cast<int>(random.below(kHeight));
    const Eigen::Vector3f p = kCamera.back_project(static_cast<float>(u), static_cast<float>(v), corner_depth_m(u, v));
    points.push_back(remembered(scene_from_camera * p));
  }
  return points;
}

AlignmentState align(const std::vector<RememberedPoint>& points, const SE3& start, int num_steps) {
  const std::vector<FeaturePixel> pixels = corner();
  const SurfaceEstimator estimator{{pixels.data(), kWidth, kHeight, 1.0F}, kCamera, 2};
  AlignmentState state{start, 0};
  for (int i = 0; i < num_steps; ++i) AlignByProjection<CpuExecutor, DrawnPoints>{estimator, {points}, 1, 0.05F, &state}(CpuTeam{}, 0);
  return state;
}

TEST_CASE("AlignByProjection: a pose centimetres off comes back, whatever the scene's frame, and outliers do not matter") {
  Random random = test::test_random();
  for (int trial = 0; trial < 5; ++trial) {
    const SE3 truth = random_motion(random, 2.0F, 3.0F);
    std::vector<RememberedPoint> points = points_of_corner(random, 2000, truth);
    for (int i = 0; i < 400; ++i) {  // half a metre in front of the surface
      const auto u = static_cast<int>(random.below(kWidth));
      const auto v = static_cast<int>(random.below(kHeight));
      points.push_back(remembered(truth * kCamera.back_project(static_cast<float>(u), static_cast<float>(v), corner_depth_m(u, v) * 0.7F)));
    }
    const AlignmentState state = align(points, truth * random_motion(random, 0.01F, 0.02F), 10);
    REQUIRE(translation_distance_m(state.scene_from_camera, truth) < 0.002F);
    REQUIRE(rotation_distance_rad(state.scene_from_camera, truth) < 0.002F);
  }
}

TEST_CASE("AlignByProjection: too few points in view leave the pose as it is") {
  Random random = test::test_random();
  const SE3 start = random_motion(random, 0.01F, 0.02F);
  for (const int num_points : {0, 50}) {
    const AlignmentState state = align(points_of_corner(random, num_points, SE3{}), start, 3);
    REQUIRE(state.ended == 0);  // the leaves' own points may do better
    REQUIRE(translation_distance_m(state.scene_from_camera, start) == 0.0F);
  }
}

TEST_CASE("AlignByProjection: points that are not valid, behind the camera or on broken surfaces count nothing") {
  Random random = test::test_random();
  std::vector<RememberedPoint> points = points_of_corner(random, 500, SE3{});
  for (RememberedPoint& point : points) point.valid = 0;
  for (int i = 0; i < 500; ++i) points.push_back(remembered({random.uniform(-1.0F, 1.0F), 0.0F, -2.0F}));
  const SE3 start = random_motion(random, 0.01F, 0.02F);
  REQUIRE(translation_distance_m(align(points, start, 1).scene_from_camera, start) == 0.0F);
}

TEST_CASE("Rejoin: a pose is drawn to the points of the latest camera, unless few of them are in view or none had depth") {
  Random random = test::test_random();
  const std::vector<FeaturePixel> pixels = corner();
  const SE3 truth = random_motion(random, 0.5F, 1.0F);
  const SE3 start = truth * random_motion(random, 0.004F, 0.01F);
  std::vector<ReservoirPoint> in_view;
  for (const RememberedPoint& point : points_of_corner(random, 2000, truth)) {
    const auto mm = [&](int k) { return static_cast<std::int16_t>(std::lround(1000.0F * point.point_scene[k])); };
    in_view.push_back({mm(0), mm(1), mm(2), 0});
  }
  std::vector<ReservoirPoint> hardly_in_view(2 * in_view.size(), {0, 0, -30000, 0});
  std::copy(in_view.begin(), in_view.end(), hardly_in_view.begin());
  const std::vector<ReservoirPoint> without_depth(2000);
  const struct {
    const std::vector<ReservoirPoint>& points;
    bool moves;
  } cases[] = {{in_view, true}, {hardly_in_view, false}, {without_depth, false}};
  for (const auto& c : cases) {
    AlignmentState state{start, 0};
    PoseCandidate best;
    const SurfaceEstimator estimator{{pixels.data(), kWidth, kHeight, 1.0F}, kCamera, 2};
    Rejoin<CpuExecutor>{{estimator, {c.points}, 8, 0.03F, &state}, &best}(CpuTeam{}, 0);
    if (c.moves) REQUIRE(translation_distance_m(best.scene_from_camera, truth) < 0.002F);
    if (!c.moves) REQUIRE(translation_distance_m(best.scene_from_camera, start) == 0.0F);
  }
}

}  // namespace
}  // namespace foothold

// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "pose/rank_kernels.h"

#include <algorithm>
#include <cstring>
#include <limits>
#include <vector>

#include "foothold/base/exec/cpu_executor.h"
#include "relocalisation/averaged_camera.h"
#include "support/catch.h"
#include "support/random_seed.h"

namespace foothold {
namespace {

using namespace test;

constexpr float kWallM = 2.0F;

/// A grey wall right in front of the camera.
std::vector<FeaturePixel> wall() {
  FeaturePixel pixel;
  pixel.channels[0] = static_cast<std::int16_t>(1000.0F * kWallM);
  for (int k = 1; k < 4; ++k) pixel.channels[k] = 100;
  return std::vector<FeaturePixel>(static_cast<std::size_t>(kWidth * kHeight), pixel);
}

RememberedPoint remembered_grey(const Eigen::Vector3f& p, std::uint8_t grey = 100) {
  return {{p.x(), p.y(), p.z()}, {grey, grey, grey}, 1};
}

SceneEvidence evidence_of(const std::vector<FeaturePixel>& pixels, const std::vector<RememberedPoint>& points, SE3 scene_from_camera) {
  const FeatureImageView image{pixels.data(), kWidth, kHeight, 1.0F};
  std::uint64_t order = 0;
  SceneEvidence evidence{-1.0F, -1.0F, -1.0F};
  float energy = 0.0F;
  const HypothesesView hypotheses{&scene_from_camera, &energy, &order};
  const auto num_points = static_cast<int>(points.size());
  JudgeCandidates<CpuExecutor>{image, kCamera, points.data(), num_points, hypotheses, &evidence}(CpuTeam{}, 0);
  return evidence;
}

/// One of eight leaves remembers points.
LeafReservoirs reservoirs_of_sparse_leaves() {
  constexpr std::uint32_t kNumLeaves = 64;
  const Context context;
  LeafReservoirs reservoirs(context, static_cast<int>(kNumLeaves), ReservoirSettings{}, 1);
  TrainingExamples examples(context.memory());
  std::vector<ReservoirPoint> points;
  std::vector<std::uint32_t> leaves;
  for (std::int16_t i = 0; i < 100; ++i) {
    points.push_back({i, static_cast<std::int16_t>(2 * i), static_cast<std::int16_t>(-i), static_cast<std::uint16_t>(i)});
    leaves.push_back(static_cast<std::uint32_t>(i) * 8 % kNumLeaves);
  }
  examples.pixels.assign(Span<const SampledPixel>(std::vector<SampledPixel>(points.size(), SampledPixel{0, 0, 1.0F})));
  examples.points.assign(Span<const ReservoirPoint>(points));
  examples.leaves.assign(Span<const std::uint32_t>(leaves));
  reservoirs.insert(context, examples);
  return reservoirs;
}

TEST_CASE("JudgeCandidates: counts points seen through, at the surface, hidden and out of view") {
  const struct {
    const char* what;
    RememberedPoint point;
    float in_view, contradicted, alike;
  } cases[] = {
      {"on the wall", remembered_grey({0.3F, 0.2F, kWallM}), 1, 0, 1},
      {"on the wall, another colour", remembered_grey({0.3F, 0.2F, kWallM}, 180), 1, 0, 0},
      {"in front of the wall", remembered_grey({0.3F, 0.2F, kWallM - 0.3F}), 1, 1, 0},
      {"behind the wall", remembered_grey({0.3F, 0.2F, kWallM + 0.3F}), 1, 0, 0},
      {"within the sensor's noise", remembered_grey({0.3F, 0.2F, kWallM - 0.03F}), 1, 0, 1},
      {"beside the image", remembered_grey({2.0F, 0.0F, kWallM}), 0, 0, 0},
      {"behind the camera", remembered_grey({0.0F, 0.0F, -kWallM}), 0, 0, 0},
      {"nothing", RememberedPoint{}, 0, 0, 0},
  };
  for (const auto& c : cases) {
    INFO(c.what);
    const SceneEvidence evidence = evidence_of(wall(), {c.point}, SE3{});
    REQUIRE(evidence.num_in_view == c.in_view);
    REQUIRE(evidence.num_contradicted == c.contradicted);
    REQUIRE(evidence.num_alike == c.alike);
  }
}

TEST_CASE("JudgeCandidates: pixels without depth prove nothing") {
  const SceneEvidence evidence =
      evidence_of(std::vector<FeaturePixel>(static_cast<std::size_t>(kWidth * kHeight)), {remembered_grey({0.0F, 0.0F, 1.0F})}, SE3{});
  REQUIRE(evidence.num_in_view == 0.0F);
}

TEST_CASE("JudgeCandidates: depends on where the camera is, not on where the scene's origin is") {
  Random random = test::test_random();
  Tangent6 twist;
  for (int k = 0; k < 6; ++k) twist[k] = random.uniform(-1.0F, 1.0F);
  const SE3 scene_from_camera = se3_exp(twist);
  std::vector<RememberedPoint> points;
  constexpr int kNumPoints = 500;
  for (int i = 0; i < kNumPoints; ++i) {
    const Eigen::Vector3f p = scene_from_camera * Eigen::Vector3f(random.uniform(-0.8F, 0.8F), random.uniform(-0.6F, 0.6F), kWallM);
    points.push_back(remembered_grey(p));
  }
  const SceneEvidence right = evidence_of(wall(), points, scene_from_camera);
  REQUIRE(right.num_in_view == kNumPoints);
  REQUIRE(right.num_contradicted == 0.0F);
  REQUIRE(right.num_alike == kNumPoints);
  // Half a metre further back, the camera would see the wall where nothing is remembered, through what is remembered.
  SE3 wrong = scene_from_camera;
  wrong.translation += wrong.rotation * Eigen::Vector3f(0.0F, 0.0F, 0.5F);
  const SceneEvidence off = evidence_of(wall(), points, wrong);
  REQUIRE(off.num_alike == 0.0F);
  REQUIRE(off.num_contradicted == off.num_in_view);
  REQUIRE(off.contradicted_fraction() > 0.9F);
}

TEST_CASE("MakeEvidenceKey: believed candidates first, equal ones as they were, failed ones last") {
  constexpr float kFailed = std::numeric_limits<float>::infinity();
  const std::vector<SceneEvidence> evidence = {{100, 0, 0}, {100, 0, 90}, {100, 60, 30}, {100, 0, 90}, {100, 0, 100}, {0, 0, 0}};
  std::vector<float> energies = {1, 2, 3, 4, kFailed, 5};
  std::vector<std::uint64_t> order = {0, 3, 2, 1, 4, 5};
  const MakeEvidenceKey make_key{evidence.data(), HypothesesView{nullptr, energies.data(), order.data()}};
  for (std::size_t slot = 0; slot < order.size(); ++slot) make_key(slot);
  std::stable_sort(order.begin(), order.end(), [](std::uint64_t a, std::uint64_t b) { return (a >> 32U) < (b >> 32U); });
  std::vector<std::uint32_t> hypotheses;
  for (const std::uint64_t key : order) hypotheses.push_back(hypothesis_of(key));
  REQUIRE(hypotheses == std::vector<std::uint32_t>{3, 1, 0, 5, 2, 4});
}

TEST_CASE("DrawRememberedPoints: draws what leaves hold, and nothing from empty ones") {
  LeafReservoirs reservoirs(Context{}, 64, ReservoirSettings{}, 1);
  RememberedPoint point = remembered_grey({1.0F, 2.0F, 3.0F});
  DrawRememberedPoints<1>{reservoirs.view(), 7, 1, &point}(0);
  REQUIRE(point.valid == 0);
}

TEST_CASE("DrawRememberedPoints: draws the same points one by one and side by side") {
  constexpr std::size_t kNumPoints = 50;  // the last group is incomplete
  constexpr int kTogether = 16;
  LeafReservoirs reservoirs = reservoirs_of_sparse_leaves();
  std::vector<RememberedPoint> single(kNumPoints);
  for (std::size_t i = 0; i < kNumPoints; ++i) DrawRememberedPoints<1>{reservoirs.view(), 7, kNumPoints, single.data()}(i);
  std::vector<RememberedPoint> together(kNumPoints, remembered_grey({9.0F, 9.0F, 9.0F}));
  for (std::size_t i = 0; i * kTogether < kNumPoints; ++i)
    DrawRememberedPoints<kTogether>{reservoirs.view(), 7, kNumPoints, together.data()}(i);
  std::size_t num_valid = 0;
  for (std::size_t i = 0; i < kNumPoints; ++i) {
    INFO(i);
    CHECK(std::memcmp(&single[i], &together[i], sizeof(RememberedPoint)) == 0);
    num_valid += single[i].valid;
  }
  CHECK(num_valid > 0);
  CHECK(num_valid < kNumPoints);
}

}  // namespace
}  // namespace foothold

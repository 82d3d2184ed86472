// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include <vector>

#include "pose/align_kernels.h"
#include "relocalisation/scenes.h"
#include "support/catch.h"

namespace foothold {
namespace {

/// Reservoirs of one leaf with the given points.
LeafReservoirs reservoirs_of(const std::vector<ReservoirPoint>& points, const Context& context) {
  ReservoirSettings settings;
  LeafReservoirs reservoirs(context, 1, settings, 42);
  TrainingExamples examples(context.memory());
  examples.pixels.assign(Span<const SampledPixel>(std::vector<SampledPixel>(points.size(), SampledPixel{0, 0, 1.0F})));
  examples.points.assign(Span<const ReservoirPoint>(points));
  examples.leaves.assign(Span<const std::uint32_t>(std::vector<std::uint32_t>(points.size(), 0U)));
  reservoirs.insert(context, examples);
  return reservoirs;
}

NearPoints near_points_of(const std::vector<ReservoirPoint>& points, const SurfaceSample& surface, const SE3& scene_from_camera) {
  LeafReservoirs reservoirs = reservoirs_of(points, test::context_of(1));
  const std::uint32_t leaf = 0;
  const AlignmentState state{scene_from_camera, 0};
  NearPoints found{};
  FindNearPoints<1>{reservoirs.view(), 1, {0, 1, &leaf}, &surface, 1, 80.0F, &state, &found}(0);
  return found;
}

TEST_CASE("FindNearPoints: finds a leaf's points within reach of the sample in the scene, and of many the first") {
  SE3 scene_from_camera;
  scene_from_camera.translation = {1.0F, 0.0F, 0.0F};
  const SurfaceSample surface{{0.0F, 0.0F, 2.0F}, {0.0F, 0.0F, -1.0F}};  // 1000, 0, 2000 mm in the scene
  const NearPoints found =
      near_points_of({{1000, 0, 2079, 0}, {1000, 0, 2081, 0}, {0, 0, 2000, 0}, {950, 50, 2000, 0}}, surface, scene_from_camera);
  REQUIRE(found.num == 2);
  CHECK(found.z_mm[0] == 2079);
  CHECK(found.x_mm[1] == 950);
  CHECK(found.y_mm[1] == 50);

  std::vector<ReservoirPoint> many(3 * kReservoirBlockSize, ReservoirPoint{1000, 0, 2000, 0});
  CHECK(near_points_of(many, surface, scene_from_camera).num == kNearPoints);
  CHECK(near_points_of(many, SurfaceSample{{0.0F, 0.0F, 2.0F}, {}}, scene_from_camera).num == 0);  // no normal
}

TEST_CASE("FindNearPoints: finds the same points one by one and several at once") {
  constexpr int kNumTrees = 2;
  constexpr std::size_t kNumSamples = 9;  // the last group of items is incomplete
  constexpr std::size_t kNumItems = kNumSamples * kNumTrees;
  LeafReservoirs reservoirs = reservoirs_of({{0, 0, 1000, 0}, {0, 0, 1050, 0}, {50, 0, 1400, 0}}, test::context_of(1));
  std::vector<SurfaceSample> surfaces;
  std::vector<std::uint32_t> leaves;
  for (std::size_t i = 0; i < kNumSamples; ++i) {
    surfaces.push_back({{0.0F, 0.0F, 1.0F + 0.05F * static_cast<float>(i)}, {0.0F, 0.0F, i == 3 ? 0.0F : -1.0F}});
    leaves.push_back(i == 5 ? 1 : 0);  // beyond the last leaf
  }
  leaves.resize(kNumItems, 0);
  const AlignmentState state{SE3{}, 0};
  const NearPoints untouched{{7}, {7}, {7}, 7};
  std::vector<NearPoints> single(kNumItems, untouched);
  std::vector<NearPoints> together(kNumItems, untouched);
  for (std::size_t i = 0; i < kNumItems; ++i) {
    FindNearPoints<1>{reservoirs.view(), kNumTrees, {0, kNumSamples, leaves.data()}, surfaces.data(), kNumItems, 80.0F, &state,
                      single.data()}(i);
  }
  for (std::size_t i = 0; i < 3; ++i) {
    FindNearPoints<8>{reservoirs.view(), kNumTrees, {0, kNumSamples, leaves.data()}, surfaces.data(), kNumItems, 80.0F, &state,
                      together.data()}(i);
  }
  for (std::size_t i = 0; i < kNumItems; ++i) {
    INFO(i);
    REQUIRE(single[i].num == together[i].num);
    for (int k = 0; k < single[i].num; ++k) CHECK(single[i].z_mm[k] == together[i].z_mm[k]);
  }
  CHECK(single[0].num == 2);
  CHECK(single[3 * kNumTrees].num == 0);  // without normal
  CHECK(single[5 * kNumTrees].num == 0);  // without leaf
}

}  // namespace
}  // namespace foothold

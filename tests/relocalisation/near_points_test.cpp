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
  const AlignmentState state{scene_from_camera, 1.0F, 0};
  NearPoints found{};
  FindNearPoints{reservoirs.view(), 1, 1, &leaf, &surface, 80.0F, &state, &found}(0);
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

}  // namespace
}  // namespace foothold

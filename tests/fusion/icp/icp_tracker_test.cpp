// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "foothold/fusion/icp_tracker.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "foothold/base/contract.h"
#include "fusion/scene.h"
#include "icp/icp_state.h"
#include "support/catch.h"
#include "support/random_seed.h"

namespace foothold {
namespace {

using test::make_context;
using test::Scene;

/// The images of these tests have half the size of a camera's.
constexpr IcpLevels kSmallImage{3, 0};

struct Model {
  explicit Model(const Context& context, const Scene& scene, float t) : volume(test::fused_arc(context, scene, 12)) {
    const RgbdFrame frame = test::render(scene, test::pose_on_arc(t));
    Raycaster(context).render(volume, test::camera_of(frame), map);
  }
  TsdfVolume volume;
  SurfaceMap map;
};

/// A frame, tracked against a map of nothing but itself, from its true pose.
TrackingResult tracked_on_itself(const Context& context, const Scene& scene, const SE3& pose) {
  const RgbdFrame frame = test::render(scene, pose);
  TsdfVolume volume(context, {});
  volume.integrate(frame.view(), pose);
  SurfaceMap map;
  Raycaster(context).render(volume, test::camera_of(frame), map);
  IcpTracker tracker(context, kSmallImage);
  tracker.set_frame(frame.view());
  return tracker.track(map, pose);
}

TEST_CASE("IcpTracker: recovers known motions against a rendered map") {
  const Scene scene;
  const Context context = make_context(1);
  const Model model(context, scene, 0.5F);
  IcpTracker tracker(context, kSmallImage);
  Random random = test::test_random();
  for (int i = 0; i < 12; ++i) {
    // Up to 3 deg and 4 cm per axis: fast hand motion at 30 frames a second.
    const SE3 truth = model.map.camera.world_from_camera * test::random_motion(random, 0.05F, 0.04F);
    const RgbdFrame frame = test::render(scene, truth);
    tracker.set_frame(frame.view());
    const TrackingResult result = tracker.track(model.map, model.map.camera.world_from_camera);
    REQUIRE(result.measures.well_posed);
    REQUIRE(translation_distance_m(result.world_from_camera, truth) < 0.001F);  // a tenth of a voxel
    REQUIRE(rotation_distance_rad(result.world_from_camera, truth) < 0.001F);
    REQUIRE(is_rigid(result.world_from_camera, 1e-5F));
    REQUIRE(result.measures.inlier_fraction > 0.8F);
  }
}

TEST_CASE("IcpTracker: frames are tracked against each other where there is no map") {
  const Scene scene;
  const Context context = make_context(1);
  IcpTracker tracker(context, kSmallImage);
  Random random = test::test_random();
  const SE3 first = test::pose_on_arc(0.5F);
  const RgbdFrame before = test::render(scene, first);
  SurfaceMap surface;
  for (int i = 0; i < 6; ++i) {
    tracker.set_frame(before.view());
    tracker.make_surface(surface);
    REQUIRE(surface.num_renderings() == 1);
    const SE3 motion = test::random_motion(random, 0.04F, 0.03F);
    const RgbdFrame after = test::render(scene, first * motion);
    tracker.set_frame(after.view());
    const TrackingResult result = tracker.track(surface, SE3{});
    REQUIRE(result.measures.well_posed);
    REQUIRE(translation_distance_m(result.world_from_camera, motion) < 0.003F);
    REQUIRE(rotation_distance_rad(result.world_from_camera, motion) < 0.003F);
    REQUIRE(result.measures.inlier_fraction > 0.8F);
  }
}

TEST_CASE("IcpTracker: survives a quarter of the image being covered") {
  const Scene scene;
  const Context context = make_context(1);
  const Model model(context, scene, 0.5F);
  IcpTracker tracker(context, kSmallImage);
  Random random = test::test_random();
  const SE3 truth = model.map.camera.world_from_camera * test::random_motion(random, 0.02F, 0.02F);
  RgbdFrame frame = test::render(scene, truth);
  for (int v = 60; v < 180; ++v) {
    for (int u = 80; u < 240; ++u) frame.depth(u, v) = 0.5F;  // a hand before the lens
  }
  tracker.set_frame(frame.view());
  const TrackingResult result = tracker.track(model.map, model.map.camera.world_from_camera);
  REQUIRE(translation_distance_m(result.world_from_camera, truth) < 0.003F);
  REQUIRE(rotation_distance_rad(result.world_from_camera, truth) < 0.003F);
  REQUIRE(result.measures.inlier_fraction < 0.8F);
}

/// Leaves a rendering's first columns only.
void unmap_from_column(SurfaceMap& map, int first) {
  for (int v = 0; v < map.camera.height; ++v) {
    for (int u = first; u < map.camera.width; ++u) map.pixels[static_cast<std::size_t>(v * map.camera.width + u)] = SurfacePixel{};
  }
}

TEST_CASE("IcpTracker: where the map ends, nothing is an outlier, and the determinants tell how much was left to go by") {
  const Scene scene;
  const Context context = make_context(1);
  Model model(context, scene, 0.5F);
  IcpTracker tracker(context, kSmallImage);
  Random random = test::test_random();
  const SE3 truth = model.map.camera.world_from_camera * test::random_motion(random, 0.02F, 0.02F);
  const RgbdFrame frame = test::render(scene, truth);
  tracker.set_frame(frame.view());
  const TrackingResult full = tracker.track(model.map, model.map.camera.world_from_camera);
  unmap_from_column(model.map, 160);  // half of the image
  const TrackingResult half = tracker.track(model.map, model.map.camera.world_from_camera);
  REQUIRE(half.measures.well_posed);
  REQUIRE(translation_distance_m(half.world_from_camera, truth) < 0.002F);
  REQUIRE(full.num_valid == 320 * 240);
  REQUIRE(half.num_valid == full.num_valid);
  REQUIRE(full.num_mapped < full.num_valid);  // what moved out of the rendering, and edges
  REQUIRE(static_cast<float>(half.num_mapped) == Approx(0.5F * static_cast<float>(full.num_mapped)).epsilon(0.1));
  REQUIRE(half.num_inliers <= half.num_mapped);
  REQUIRE(half.measures.inlier_fraction == Approx(full.measures.inlier_fraction).margin(0.05));
  REQUIRE(half.measures.residual_m == Approx(full.measures.residual_m).margin(0.01));
  // Half as many pixels give about half of the Hessian: 6 log 2 of its determinant, and what the other half alone saw.
  REQUIRE(half.measures.log_det_valid < full.measures.log_det_valid - 3.0F);
}

TEST_CASE("IcpTracker: a strip that agrees is no evidence") {
  const Scene scene;
  const Context context = make_context(1);
  Model model(context, scene, 0.5F);
  IcpTracker tracker(context, kSmallImage);
  const RgbdFrame frame = test::render(scene, model.map.camera.world_from_camera);
  tracker.set_frame(frame.view());
  float last_residual_m = tracker.track(model.map, model.map.camera.world_from_camera).measures.residual_m;
  for (const int columns : {32, 16, 8, 4}) {  // a tenth of the image and less
    unmap_from_column(model.map, columns);
    const TrackingResult result = tracker.track(model.map, model.map.camera.world_from_camera);
    REQUIRE(result.measures.inlier_fraction < 5.0F * static_cast<float>(columns) / 320.0F + 0.01F);
    REQUIRE(result.measures.residual_m > last_residual_m);
    last_residual_m = result.measures.residual_m;
  }
  unmap_from_column(model.map, 0);
  const TrackingResult nothing = tracker.track(model.map, model.map.camera.world_from_camera);
  REQUIRE_FALSE(nothing.measures.well_posed);
  REQUIRE(nothing.num_mapped == 0);
  REQUIRE(nothing.measures.inlier_fraction == 0.0F);
  REQUIRE(nothing.measures.residual_m == Approx(kCoarsestOutlierM));
}

TEST_CASE("IcpTracker: a plane alone is ill-posed in the measures, and moves nothing along itself") {
  Scene plane;
  plane.sphere_centre_world = {0.0, 0.0, -100.0};
  const Context context = make_context(1);
  const SE3 pose = test::look_at({0.0F, 0.0F, 0.9F}, {0.0F, 0.0F, 1.5F});  // 60 cm before the far wall: nothing else in view
  const TrackingResult on_plane = tracked_on_itself(context, plane, pose);
  REQUIRE(translation_distance_m(on_plane.world_from_camera, pose) < 0.02F);

  const Model model(context, Scene{}, 0.5F);
  const RgbdFrame full = test::render(Scene{}, model.map.camera.world_from_camera);
  IcpTracker tracker(context, kSmallImage);
  tracker.set_frame(full.view());
  const TrackingResult in_room = tracker.track(model.map, model.map.camera.world_from_camera);
  REQUIRE((!on_plane.measures.well_posed || on_plane.measures.log_det_total < in_room.measures.log_det_total - 10.0F));
}

TEST_CASE("IcpTracker: between a wall and a floor, the loosest translation is along both") {
  Scene corridor;
  corridor.half_size_m.x() = 6.0;  // its ends are out of sight
  corridor.sphere_centre_world = {0.0, 0.0, -100.0};
  const TrackingResult result = tracked_on_itself(make_context(1), corridor, test::look_at({0.0F, 0.0F, 0.0F}, {0.3F, 0.9F, 1.5F}));
  REQUIRE(result.measures.well_posed);  // voxels are not quite flat
  REQUIRE(result.loosest_world.norm() == Approx(1.0F));
  REQUIRE(std::abs(result.loosest_world.x()) > 0.99F);
}

TEST_CASE("IcpTracker: a frame without depth, or of another place, is hopeless but harms nothing") {
  const Scene scene;
  const Context context = make_context(1);
  const Model model(context, scene, 0.5F);
  IcpTracker tracker(context, kSmallImage);
  RgbdFrame frame = test::render(scene, test::pose_on_arc(0.5F));
  for (const float value : {0.0F, -1.0F, std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()}) {
    for (std::size_t i = 0; i < frame.depth.size(); ++i) frame.depth.data()[i] = value;
    tracker.set_frame(frame.view());
    const TrackingResult result = tracker.track(model.map, model.map.camera.world_from_camera);
    REQUIRE_FALSE(result.measures.well_posed);
    REQUIRE(result.num_inliers == 0);
    REQUIRE(is_rigid(result.world_from_camera, 1e-4F));
  }
  const SE3 elsewhere = test::look_at({0.0F, 0.0F, 30.0F}, {0.0F, 0.0F, 31.0F});
  frame = test::render(scene, test::pose_on_arc(0.5F));
  tracker.set_frame(frame.view());
  const TrackingResult result = tracker.track(model.map, elsewhere);
  REQUIRE_FALSE(result.measures.well_posed);
  REQUIRE(result.measures.inlier_fraction == 0.0F);
}

TEST_CASE("IcpTracker: identical for any number of threads") {
  const Scene scene;
  Random random = test::test_random();
  const SE3 motion = test::random_motion(random, 0.03F, 0.03F);
  TrackingResult one;
  for (const int num_threads : {1, 2, 4}) {
    const Context context = make_context(num_threads);
    const Model model(context, scene, 0.5F);
    IcpTracker tracker(context, kSmallImage);
    const RgbdFrame frame = test::render(scene, model.map.camera.world_from_camera * motion);
    tracker.set_frame(frame.view());
    const TrackingResult result = tracker.track(model.map, model.map.camera.world_from_camera);
    if (num_threads == 1) one = result;
    REQUIRE(result.world_from_camera.rotation == one.world_from_camera.rotation);
    REQUIRE(result.world_from_camera.translation == one.world_from_camera.translation);
    REQUIRE(result.measures.log_det_total == one.measures.log_det_total);
    REQUIRE(result.measures.residual_m == one.measures.residual_m);
  }
}

TEST_CASE("IcpTracker: several alignments at once end where each ends alone") {
  const Scene scene;
  const Context context = make_context();
  const TsdfVolume volume = test::fused_arc(context, scene, 12);
  const RgbdFrame frame = test::render(scene, test::pose_on_arc(0.5F));
  IcpTracker tracker(context, kSmallImage);
  tracker.set_frame(frame.view());
  Random random = test::test_random();
  std::vector<SE3> guesses;
  for (int i = 0; i < 4; ++i) guesses.push_back(*frame.world_from_camera * test::random_motion(random, 0.05F, 0.05F));
  guesses.push_back(test::look_at({0.0F, 0.0F, 20.0F}, {0.0F, 0.0F, 30.0F}));  // sees nothing
  const Array<SE3> starts(MemoryKind::kHost, Span<const SE3>(guesses));
  SurfaceMap models;
  Raycaster raycaster(context);
  raycaster.render_all(volume, test::camera_of(frame), starts, models);
  tracker.align_all(models, starts);
  HostReads reads;
  tracker.queue_results(reads);
  reads.wait(context);
  const std::vector<TrackingResult> together = tracker.results();
  REQUIRE(together.size() == guesses.size());
  REQUIRE(tracker.world_from_cameras().size() == guesses.size());
  for (std::size_t i = 0; i < guesses.size(); ++i) {
    RenderCamera camera = test::camera_of(frame);
    camera.world_from_camera = guesses[i];
    SurfaceMap model;
    raycaster.render(volume, camera, model);
    const TrackingResult alone = tracker.track(model, guesses[i]);
    REQUIRE(together[i].world_from_camera.rotation == alone.world_from_camera.rotation);
    REQUIRE(together[i].world_from_camera.translation == alone.world_from_camera.translation);
    REQUIRE(together[i].measures.well_posed == alone.measures.well_posed);
    REQUIRE(together[i].measures.residual_m == alone.measures.residual_m);
    REQUIRE(together[i].num_inliers == alone.num_inliers);
    REQUIRE(is_rigid(together[i].world_from_camera, 1e-6F));
  }
  REQUIRE_FALSE(together.back().measures.well_posed);
}

TEST_CASE("IcpLevels: two, of which the finest has the pixels of the reduced image, and others than the pyramid's are refused") {
  for (const auto& [divisor, finest] : {std::pair{1, 0}, {2, 1}, {4, 2}, {5, 2}, {8, 3}, {1000, 5}}) {
    REQUIRE(IcpLevels::for_divisor(divisor).finest == finest);
    REQUIRE(IcpLevels::for_divisor(divisor).coarsest == finest + 1);
  }
  for (const IcpLevels& levels : {IcpLevels{1, 2}, IcpLevels{7, 2}, IcpLevels{1, -1}})
    REQUIRE_THROWS_AS(IcpTracker(Context(), levels), ContractViolation);
}

TEST_CASE("IcpTracker: sees depth where one reading is in range") {
  const Context context = make_context(1);
  IcpTracker tracker(context, {1, 0}, {0.5F, 2.0F});
  RgbdFrame frame = test::render(Scene{}, test::pose_on_arc(0.5F), 64, 48);
  const auto sees_depth = [&](float depth_m) {
    std::fill_n(frame.depth.data(), frame.depth.size(), 0.0F);
    frame.depth(40, 30) = depth_m;
    tracker.set_frame(frame.view());
    return tracker.sees_depth();
  };
  for (const float depth_m : {0.5F, 1.0F, 2.0F}) REQUIRE(sees_depth(depth_m));
  for (const float depth_m : {0.0F, 0.49F, 2.01F, -1.0F, std::numeric_limits<float>::quiet_NaN()}) REQUIRE_FALSE(sees_depth(depth_m));
}

}  // namespace
}  // namespace foothold

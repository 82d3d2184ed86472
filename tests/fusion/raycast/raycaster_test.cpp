// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "foothold/fusion/raycaster.h"

#include <algorithm>
#include <cstring>

#include "foothold/base/trace.h"
#include "fusion/scene.h"
#include "support/catch.h"

namespace foothold {
namespace {

using test::make_context;
using test::Scene;

TEST_CASE("Raycaster: depth and normals are those of the scene, from poses that no frame was taken from") {
  const Scene scene;
  const Context context = make_context(1);
  const TsdfVolume volume = test::fused_arc(context, scene, 12);
  Raycaster raycaster(context);
  SurfaceMap map;
  for (const float t : {0.0F, 0.37F, 0.81F}) {
    SE3 pose = test::pose_on_arc(t);
    pose.translation += Eigen::Vector3f(0.03F, -0.05F, 0.1F);
    const RenderCamera camera{{150.0F, 150.0F, 119.5F, 79.5F}, 240, 160, pose};
    raycaster.render(volume, camera, map, true);
    REQUIRE(map.pixels.size() == 240U * 160U);
    std::vector<double> errors_m;
    std::vector<double> angles_deg;
    int num_wrong = 0;
    for (int v = 0; v < camera.height; ++v) {
      for (int u = 0; u < camera.width; ++u) {
        const SurfacePixel& pixel = map.pixels[static_cast<std::size_t>(v * camera.width + u)];
        if (pixel.depth_m == 0.0F) continue;
        const double truth = scene.depth_m(camera.intrinsics, pose, u, v);
        errors_m.push_back(std::abs(double{pixel.depth_m} - truth));
        num_wrong += errors_m.back() > 0.01 ? 1 : 0;
        if (!pixel.has_normal()) continue;
        const Eigen::Vector3f point =
            pose * camera.intrinsics.back_project(static_cast<float>(u), static_cast<float>(v), static_cast<float>(truth));
        const Eigen::Vector3d p = point.cast<double>();
        Eigen::Vector3d normal = p - scene.sphere_centre_world;
        if (std::abs(normal.norm() - scene.sphere_radius_m) > 1e-4) {
          int axis = 0;
          (p.cwiseAbs() - scene.half_size_m).maxCoeff(&axis);
          normal = Eigen::Vector3d::Zero();
          normal[axis] = p[axis] > 0.0 ? -1.0 : 1.0;
        }
        const Eigen::Vector3f rendered(pixel.normal_x, pixel.normal_y, pixel.normal_z);
        const double cosine = (pose.rotation * rendered).cast<double>().dot(normal.normalized());
        angles_deg.push_back(std::acos(std::min(1.0, cosine)) * 57.29578);
      }
    }
    REQUIRE(errors_m.size() * 10 > map.pixels.size() * 9);
    REQUIRE(quantile(errors_m, 0.5) < 0.0005);  // a twentieth of a voxel
    REQUIRE(quantile(errors_m, 0.95) < 0.003);
    REQUIRE(num_wrong < 0.02 * static_cast<double>(errors_m.size()));  // edges of the sphere and of the room
    REQUIRE(quantile(angles_deg, 0.5) < 1.0);
    REQUIRE(quantile(angles_deg, 0.95) < 6.0);
  }
}

TEST_CASE("Raycaster: colours are those that were fused") {
  const Scene scene;
  const Context context = make_context(1);
  const TsdfVolume volume = test::fused_arc(context, scene, 6);
  Raycaster raycaster(context);
  SurfaceMap map;
  const RgbdFrame frame = test::render(scene, test::pose_on_arc(0.5F));
  raycaster.render(volume, test::camera_of(frame), map, true);
  std::vector<double> differences;
  for (std::size_t i = 0; i < map.pixels.size(); ++i) {
    if (map.pixels[i].depth_m == 0.0F) continue;
    const Rgb8 a = map.colours[i];
    const Rgb8 b = frame.colour.data()[i];
    differences.push_back(std::max({std::abs(a.r - b.r), std::abs(a.g - b.g), std::abs(a.b - b.b)}));
  }
  REQUIRE(quantile(differences, 0.95) <= 3.0);  // grey levels; a pixel's colour changes by one across about 2 cm
}

TEST_CASE("Raycaster: identical for any number of threads") {
  const Scene scene;
  const RenderCamera camera{{150.0F, 150.0F, 120.0F, 80.0F}, 241, 161, test::pose_on_arc(0.4F)};
  std::vector<SurfacePixel> one;
  for (const int num_threads : {1, 2, 4}) {
    const Context context = make_context(num_threads);
    const TsdfVolume volume = test::fused_arc(context, scene, 3);
    SurfaceMap map;
    Raycaster(context).render(volume, camera, map);
    const std::vector<SurfacePixel> pixels = map.pixels.to_host();
    if (num_threads == 1) one = pixels;
    REQUIRE(std::memcmp(pixels.data(), one.data(), one.size() * sizeof(SurfacePixel)) == 0);
  }
}

TEST_CASE("Raycaster: several poses at once show what each shows alone") {
  const Context context = make_context();
  const TsdfVolume volume = test::fused_arc(context, Scene{}, 3);
  Raycaster raycaster(context);
  RenderCamera camera{{75.0F, 75.0F, 60.0F, 40.0F}, 121, 81, SE3{}};
  const std::vector<SE3> poses = {test::pose_on_arc(0.4F), test::look_at({0.0F, 0.0F, 20.0F}, {0.0F, 0.0F, 30.0F}),
                                  test::pose_on_arc(0.9F)};
  SurfaceMap together;
  raycaster.render_all(volume, camera, Array<SE3>(MemoryKind::kHost, Span<const SE3>(poses)), together, true);
  REQUIRE(together.num_renderings() == poses.size());
  REQUIRE(together.colours.size() == together.pixels.size());
  for (std::size_t i = 0; i < poses.size(); ++i) {
    SurfaceMap alone;
    camera.world_from_camera = poses[i];
    raycaster.render(volume, camera, alone, true);
    const std::size_t count = alone.pixels.size();
    REQUIRE(together.pixels.size() == poses.size() * count);
    REQUIRE(std::memcmp(together.pixels.data() + i * count, alone.pixels.data(), count * sizeof(SurfacePixel)) == 0);
    REQUIRE(std::memcmp(together.colours.data() + i * count, alone.colours.data(), count * sizeof(Rgb8)) == 0);
  }
}

int num_hit(const SurfaceMap& map) {
  return static_cast<int>(
      std::count_if(map.pixels.begin(), map.pixels.end(), [](const SurfacePixel& pixel) { return pixel.depth_m != 0.0F; }));
}

TEST_CASE("Raycaster: an empty map, a view of nothing and a view from inside a wall hit nothing") {
  const Context context = make_context(1);
  Raycaster raycaster(context);
  SurfaceMap map;
  const Intrinsics k{100.0F, 100.0F, 49.5F, 39.5F};
  const auto num_hit_from = [&](const TsdfVolume& volume, const SE3& pose) {
    raycaster.render(volume, {k, 100, 80, pose}, map, true);
    return num_hit(map);
  };
  REQUIRE(num_hit_from(TsdfVolume(context, {}), SE3{}) == 0);
  const TsdfVolume volume = test::fused_arc(context, Scene{}, 3);
  REQUIRE(num_hit_from(volume, test::look_at({0.0F, 0.0F, 20.0F}, {0.0F, 0.0F, 30.0F})) == 0);
  // The back of the far wall is no surface: rays pass through it, and through the sphere's back, into the unseen.
  REQUIRE(num_hit_from(volume, test::look_at({0.0F, 0.0F, 2.5F}, {0.0F, 0.01F, 1.4F})) < 80);
}

/// A frame that sees a wall left of a column, nothing to the right of it.
RgbdFrame wall_left_of(int column) {
  RgbdFrame frame = test::render(Scene{}, SE3{}, 64, 48);
  for (int v = 0; v < 48; ++v) {
    for (int u = 0; u < 64; ++u) frame.depth(u, v) = u < column ? 2.0F : 0.0F;
  }
  return frame;
}

TEST_CASE("Raycaster: surfaces hundreds of kilometres away neither hold a ray up nor hide what is near") {
  const Context context = make_context(1);
  TsdfSettings settings;
  settings.voxel_size_m = 0.09F;
  settings.truncation_m = 0.3F;
  TsdfVolume volume(context, settings);
  const RgbdFrame near = wall_left_of(28);
  volume.integrate(near.view(), SE3{});
  Raycaster raycaster(context);
  const RenderCamera camera{near.calibration.depth, 64, 48, SE3{}};
  SurfaceMap alone;
  raycaster.render(volume, camera, alone);
  REQUIRE(num_hit(alone) > 1000);
  for (const float z_m : {4e5F, -4e5F}) {  // straight ahead, where rays pass by the wall, and behind
    SE3 pose;
    pose.translation.z() = z_m;
    volume.integrate(wall_left_of(64).view(), pose);
  }
  SurfaceMap map;
  raycaster.render(volume, camera, map);
  REQUIRE(num_hit(map) == num_hit(alone));
  for (const Eigen::Vector3f& position :
       {Eigen::Vector3f(0.0F, 0.0F, 3.9999e5F), Eigen::Vector3f(1e12F, 0.0F, 0.0F), Eigen::Vector3f(0.0F, 1e30F, -1e30F)}) {
    raycaster.render(volume, {near.calibration.depth, 64, 48, {Eigen::Matrix3f::Identity(), position}}, map);  // comes to an end
  }
}

TEST_CASE("Raycaster: a camera without focal length sees nothing, and that soon") {
  const Context context = make_context(1);
  const TsdfVolume volume = test::fused_arc(context, Scene{}, 3);
  Raycaster raycaster(context);
  SurfaceMap map;
  for (const float focal_px : {1e-3F, 1e-6F, 1e-30F, 1e-44F}) {
    raycaster.render(volume, {{focal_px, focal_px, 32.0F, 24.0F}, 64, 48, test::pose_on_arc(0.5F)}, map, true);
    REQUIRE(num_hit(map) <= 1);  // straight ahead at most
  }
}

}  // namespace
}  // namespace foothold

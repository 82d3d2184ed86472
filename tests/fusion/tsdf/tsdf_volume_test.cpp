// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "foothold/fusion/tsdf_volume.h"

#include <limits>
#include <sstream>

#include "foothold/base/error.h"
#include "fusion/scene.h"
#include "support/catch.h"
#include "support/random_seed.h"
#include "tsdf/tsdf_view.h"

namespace foothold {
namespace {

using test::make_context;
using test::Scene;

std::string bytes_of(const TsdfVolume& volume) {
  std::ostringstream stream;
  volume.save(stream);
  return stream.str();
}

TEST_CASE("TsdfVolume: distances at observed points are those of the scene") {
  const Scene scene;
  const Context context = make_context(1);
  const TsdfVolume volume = test::fused_arc(context, scene, 8);
  VoxelReader<> reader(volume.view());
  Random random = test::test_random();
  // Distance is measured along the optical axis of each camera, so it exceeds the true one by up to 1 / cos of the angle of incidence; near
  // the surface both vanish. A pixel of these images is 6 to 12 mm wide on the walls, so points on the surface may read up to a voxel, and
  // a quarter as a rule.
  const float voxel = volume.settings().voxel_size_m / volume.settings().truncation_m;
  std::vector<double> distances;
  for (int i = 0; i < 2000; ++i) {
    const SE3 pose = test::pose_on_arc(0.5F);
    const Intrinsics k{160.0F, 160.0F, 159.5F, 119.5F};
    const int u = static_cast<int>(random.below(300)) + 10;
    const int v = static_cast<int>(random.below(220)) + 10;
    const Eigen::Vector3f point =
        pose * k.back_project(static_cast<float>(u), static_cast<float>(v), static_cast<float>(scene.depth_m(k, pose, u, v)));
    const Eigen::Vector3d room_point = point.cast<double>().cwiseAbs() - scene.half_size_m;
    // Away from edges, where the function has a kink.
    const double to_sphere = std::abs((point.cast<double>() - scene.sphere_centre_world).norm() - scene.sphere_radius_m);
    if (to_sphere < 1e-3 || (to_sphere < 0.1 && to_sphere > 1e-3)) continue;
    int num_near = 0;
    for (int axis = 0; axis < 3; ++axis) num_near += room_point[axis] > -0.08 ? 1 : 0;
    if (num_near != 1) continue;
    float distance = 0.0F;
    const Eigen::Vector3f g = point / volume.settings().voxel_size_m;
    if (!reader.interpolate(g.x(), g.y(), g.z(), distance)) continue;
    distances.push_back(std::abs(distance));
  }
  REQUIRE(distances.size() > 500);
  REQUIRE(quantile(distances, 0.5) < 0.1F * voxel);
  REQUIRE(quantile(distances, 0.95) < 0.25F * voxel);
  REQUIRE(quantile(distances, 1.0) < voxel);
}

TEST_CASE("TsdfVolume: free space reads one, the unseen reads unobserved") {
  const Context context = make_context(1);
  TsdfSettings settings;
  settings.truncation_m = 0.04F;  // less than the 5 cm from the voxel below to the wall
  const TsdfVolume volume = test::fused_arc(context, Scene{}, 4, settings);
  VoxelReader<> reader(volume.view());
  REQUIRE(reader.stored(0, 0, 0) == kUnobserved);        // free space without blocks
  REQUIRE(reader.stored(20, 30, 75) == kUnobserved);     // inside the sphere, deeper than the band
  REQUIRE(reader.stored(0, 0, 1000000) == kUnobserved);  // far outside
  REQUIRE(reader.stored(-60, -30, 145) == static_cast<std::int16_t>(kStoredOne));
  REQUIRE(reader.stored(-100, -50, 200) == kUnobserved);
}

TEST_CASE("TsdfVolume: contents are identical for any number of threads") {
  const Scene scene;
  const std::string one = bytes_of(test::fused_arc(make_context(1), scene, 5));
  for (const int num_threads : {2, 4}) REQUIRE(bytes_of(test::fused_arc(make_context(num_threads), scene, 5)) == one);
}

TEST_CASE("TsdfVolume: grows without bounds, also across the origin and far from it") {
  const Context context = make_context(1);
  for (const float offset_m : {0.0F, 900.0F, -900.0F}) {
    TsdfVolume volume(context, {});
    SE3 pose = test::pose_on_arc(0.0F);
    const RgbdFrame frame = test::render(Scene{}, pose);
    pose.translation.array() += offset_m;
    const IntegrationStats stats = volume.integrate(frame.view(), pose);
    REQUIRE(stats.num_new_blocks > 1000);
    REQUIRE(stats.num_blocks_refused == 0);
    REQUIRE(volume.num_blocks() == stats.num_new_blocks);
    REQUIRE(volume.integrate(frame.view(), pose).num_new_blocks == 0);
  }
}

TEST_CASE("TsdfVolume: max_blocks is kept, and what fits is still fused") {
  TsdfSettings settings;
  settings.max_blocks = 100;
  const Context context = make_context(1);
  TsdfVolume volume(context, settings);
  const SE3 pose = test::pose_on_arc(0.0F);
  const RgbdFrame frame = test::render(Scene{}, pose);
  const IntegrationStats stats = volume.integrate(frame.view(), pose);
  REQUIRE(stats.num_new_blocks == 100);
  REQUIRE(stats.num_blocks_refused > 0);
  REQUIRE(volume.num_blocks() == 100);
}

TEST_CASE("TsdfVolume: frames without usable depth change nothing") {
  const Context context = make_context(1);
  TsdfVolume volume = test::fused_arc(context, Scene{}, 2);
  const std::string before = bytes_of(volume);
  const SE3 pose = test::pose_on_arc(0.5F);
  RgbdFrame frame = test::render(Scene{}, pose);
  for (const float value : {0.0F, -1.0F, std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity(), 1e9F, 0.01F}) {
    for (std::size_t i = 0; i < frame.depth.size(); ++i) frame.depth.data()[i] = value;
    REQUIRE(volume.integrate(frame.view(), pose).num_new_blocks == 0);
    REQUIRE(bytes_of(volume) == before);
  }
}

TEST_CASE("TsdfVolume: copies are independent, reset forgets") {
  const Context context = make_context(1);
  TsdfVolume volume = test::fused_arc(context, Scene{}, 2);
  const std::string before = bytes_of(volume);
  TsdfVolume copy = volume;
  REQUIRE(bytes_of(copy) == before);
  const RgbdFrame frame = test::render(Scene{}, test::pose_on_arc(1.0F));
  copy.integrate(frame.view(), *frame.world_from_camera);
  REQUIRE(bytes_of(copy) != before);
  REQUIRE(bytes_of(volume) == before);
  copy.reset();
  REQUIRE(copy.num_blocks() == 0);
  REQUIRE(bytes_of(copy) == bytes_of(TsdfVolume(context, {})));
}

TEST_CASE("TsdfVolume: a loaded map equals the saved one and goes on alike") {
  const Context context = make_context(1);
  TsdfSettings settings;
  settings.voxel_size_m = 0.02F;
  settings.truncation_m = 0.08F;
  TsdfVolume volume = test::fused_arc(context, Scene{}, 3, settings);
  std::stringstream stream(bytes_of(volume));
  TsdfVolume loaded(context, {});
  loaded.load(stream);
  REQUIRE(loaded.settings().voxel_size_m == settings.voxel_size_m);
  REQUIRE(bytes_of(loaded) == bytes_of(volume));
  const RgbdFrame frame = test::render(Scene{}, test::pose_on_arc(1.0F));
  volume.integrate(frame.view(), *frame.world_from_camera);
  loaded.integrate(frame.view(), *frame.world_from_camera);
  REQUIRE(bytes_of(loaded) == bytes_of(volume));
}

TEST_CASE("TsdfVolume: damaged maps are refused and the former map stays") {
  const Context context = make_context(1);
  TsdfSettings settings;
  settings.voxel_size_m = 0.05F;
  settings.truncation_m = 0.1F;
  const std::string good = bytes_of(test::fused_arc(context, Scene{}, 1, settings));
  TsdfVolume volume = test::fused_arc(context, Scene{}, 2, settings);
  const std::string before = bytes_of(volume);
  const auto require_refused = [&](const std::string& bytes) {
    std::istringstream stream(bytes);
    REQUIRE_THROWS_AS(volume.load(stream), FileError);
    REQUIRE(bytes_of(volume) == before);
  };
  require_refused("");
  require_refused("not a map");
  Random random = test::test_random();
  for (int i = 0; i < 40; ++i) require_refused(good.substr(0, random.below(static_cast<std::uint32_t>(good.size()))));
  for (int i = 0; i < 80; ++i) {
    // Every field of the header, then bytes anywhere.
    const std::size_t place = i < 48 ? static_cast<std::size_t>(i) : random.below(static_cast<std::uint32_t>(good.size()));
    std::string bad = good;
    bad[place] = static_cast<char>(bad[place] ^ static_cast<char>(1U << random.below(8)));
    require_refused(bad);
  }
}

TEST_CASE("TsdfSettings: defaults are as documented, and each range is enforced") {
  const TsdfSettings defaults;
  REQUIRE(defaults.voxel_size_m == 0.01F);
  REQUIRE(defaults.truncation_m == 0.06F);
  REQUIRE(defaults.max_weight == 255);
  REQUIRE(defaults.min_depth_m == 0.2F);
  REQUIRE(defaults.max_depth_m == 5.0F);
  REQUIRE(defaults.max_blocks == 1 << 20);
  REQUIRE_NOTHROW(defaults.validate());
  const auto require_invalid = [](auto change) {
    TsdfSettings settings;
    change(settings);
    REQUIRE_THROWS_AS(settings.validate(), InvalidSettings);
  };
  require_invalid([](TsdfSettings& s) { s.voxel_size_m = 0.0F; });
  require_invalid([](TsdfSettings& s) { s.truncation_m = 0.015F; });
  require_invalid([](TsdfSettings& s) { s.max_weight = 256; });
  require_invalid([](TsdfSettings& s) { s.min_depth_m = 6.0F; });
  require_invalid([](TsdfSettings& s) { s.max_depth_m = std::numeric_limits<float>::quiet_NaN(); });
  require_invalid([](TsdfSettings& s) { s.max_blocks = 0; });
}

TEST_CASE("TsdfVolume: malformed frames and poses are contract violations") {
  const Context context = make_context(1);
  TsdfVolume volume(context, {});
  RgbdFrame frame = test::render(Scene{}, SE3{});
  SE3 skewed;
  skewed.rotation(0, 1) = 0.5F;
  REQUIRE_THROWS_AS(volume.integrate(frame.view(), skewed), ContractViolation);
  frame.colour = Image<Rgb8>();
  REQUIRE_THROWS_AS(volume.integrate(frame.view(), SE3{}), ContractViolation);
}

}  // namespace
}  // namespace foothold

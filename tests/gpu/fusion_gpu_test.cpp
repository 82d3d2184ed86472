// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// Fusion on CUDA against the same on the CPU.
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <vector>

#include "foothold/frames/frame_uploader.h"
#include "foothold/fusion/fusion_pipeline.h"
#include "foothold/fusion/icp_tracker.h"
#include "foothold/fusion/raycaster.h"
#include "foothold/fusion/tsdf_volume.h"
#include "foothold/fusion/view_comparer.h"
#include "fusion/scene.h"
#include "gpu/device.h"
#include "support/catch.h"
#include "support/random_seed.h"
#include "tsdf/tsdf_view.h"

namespace foothold {
namespace {

/// Stored distances may differ by this many of 32767 steps per truncation distance (0.006 mm): the devices' compilers may order additions
/// differently.
constexpr int kDistanceTolerance_steps = 2;
/// A voxel at the border of a pixel may see its neighbour's depth: at most this part of them.
constexpr double kMaxDeviatingVoxels = 1e-4;
constexpr float kDepthTolerance_m = 1e-4F;
/// Rays that graze an edge may hit on one device and miss on the other.
constexpr double kMaxDeviatingPixels = 1e-3;

/// Coarse enough for the emulated device.
TsdfSettings coarse() {
  TsdfSettings settings;
  settings.voxel_size_m = 0.04F;
  settings.truncation_m = 0.12F;
  return settings;
}

/// A map of the scene's arc on a device.
TsdfVolume map_on(const Context& context, int num_frames) {
  TsdfVolume volume(context, coarse());
  FrameUploader uploader(context);
  for (int i = 0; i < num_frames; ++i) {
    const SE3 pose = test::pose_on_arc(static_cast<float>(i) / 3.0F);
    const RgbdFrame frame = test::render(test::Scene{}, pose, 160, 120);
    volume.integrate(uploader.upload(frame.view()), pose);
  }
  return volume;
}

TEST_CASE("CUDA: a map has the CPU's blocks in the CPU's order, and its distances within the tolerance") {
  const Context host = test::context_on(Device::kCpu);
  const TsdfVolume expected = map_on(host, 3);
  const TsdfVolume actual(map_on(test::context_on(Device::kCuda), 3), host);
  REQUIRE(expected.num_blocks() > 50);
  REQUIRE(actual.num_blocks() == expected.num_blocks());
  long num_voxels = 0;
  long num_deviating = 0;
  for (int b = 0; b < expected.num_blocks(); ++b) {
    REQUIRE(actual.view().block_keys[b] == expected.view().block_keys[b]);
    REQUIRE(actual.view().find(expected.view().block_keys[b]) == b);
    const VoxelBlock& left = actual.view().block(b);
    const VoxelBlock& right = expected.view().block(b);
    for (int i = 0; i < kBlockVoxels; ++i, ++num_voxels) {
      const bool near = std::abs(left.distance[i] - right.distance[i]) <= kDistanceTolerance_steps && left.weight[i] == right.weight[i] &&
                        std::abs(left.red[i] - right.red[i]) <= 1;
      num_deviating += near ? 0 : 1;
    }
  }
  INFO(num_deviating << " of " << num_voxels << " voxels");
  REQUIRE(static_cast<double>(num_deviating) <= kMaxDeviatingVoxels * static_cast<double>(num_voxels));
  if (test::device_is_emulated()) REQUIRE(num_deviating == 0);
}

TEST_CASE("CUDA: maps copy from host to device and back unchanged, and grow on after it") {
  const Context host = test::context_on(Device::kCpu);
  const TsdfVolume map = map_on(host, 2);
  TsdfVolume on_device(map, test::context_on(Device::kCuda));
  const RgbdFrame frame = test::render(test::Scene{}, test::pose_on_arc(0.9F), 160, 120);
  const TsdfVolume back(on_device, host);
  REQUIRE(back.num_blocks() == map.num_blocks());
  for (int b = 0; b < map.num_blocks(); ++b) REQUIRE(std::memcmp(&back.view().block(b), &map.view().block(b), sizeof(VoxelBlock)) == 0);
  FrameUploader uploader(on_device.context());
  REQUIRE(on_device.integrate(uploader.upload(frame.view()), test::pose_on_arc(0.9F)).num_new_blocks > 0);
}

/// One map on both devices, and what the same camera sees of it.
struct TwoViews {
  Context host = test::context_on(Device::kCpu);
  Context device = test::context_on(Device::kCuda);
  TsdfVolume map = map_on(host, 3);
  TsdfVolume map_on_device{map, device};
  RenderCamera camera = test::camera_of(test::render(test::Scene{}, test::pose_on_arc(0.4F), 160, 120));
  SurfaceMap expected{host.memory()};
  SurfaceMap actual{device.memory()};

  TwoViews() {
    Raycaster(host).render(map, camera, expected, true);
    Raycaster(device).render(map_on_device, camera, actual, true);
  }
};

TEST_CASE("CUDA: a rendering shows the CPU's depths and normals") {
  const TwoViews views;
  const Context& device = views.device;
  const SurfaceMap& expected = views.expected;
  const SurfaceMap& actual = views.actual;
  const std::vector<SurfacePixel> left = actual.pixels.to_host(device);
  const std::vector<Rgb8> colours = actual.colours.to_host(device);
  REQUIRE(left.size() == expected.pixels.size());
  std::size_t num_deviating = 0;
  std::size_t num_hits = 0;
  for (std::size_t i = 0; i < left.size(); ++i) {
    const SurfacePixel& right = expected.pixels[i];
    num_hits += right.depth_m > 0.0F ? 1 : 0;
    const bool near = std::abs(left[i].depth_m - right.depth_m) < kDepthTolerance_m &&
                      std::abs(left[i].normal_z - right.normal_z) < 0.01F && std::abs(colours[i].g - expected.colours[i].g) <= 1;
    num_deviating += near ? 0 : 1;
  }
  REQUIRE(num_hits > left.size() / 2);
  INFO(num_deviating << " of " << left.size() << " pixels");
  REQUIRE(static_cast<double>(num_deviating) <= kMaxDeviatingPixels * static_cast<double>(left.size()));
  if (test::device_is_emulated()) REQUIRE(num_deviating == 0);
}

TEST_CASE("CUDA: tracking gives the CPU's poses and measures") {
  const TwoViews views;
  const SE3& start = views.camera.world_from_camera;
  constexpr IcpLevels kSmallImage{2, 0};
  IcpTracker host_tracker(views.host, kSmallImage);
  IcpTracker device_tracker(views.device, kSmallImage);
  FrameUploader uploader(views.device);
  Random random = test::test_random();
  for (int i = 0; i < 4; ++i) {
    const RgbdFrame frame = test::render(test::Scene{}, start * test::random_motion(random, 0.03F, 0.02F), 160, 120);
    host_tracker.set_frame(frame.view());
    device_tracker.set_frame(uploader.upload(frame.view()));
    const TrackingResult expected = host_tracker.track(views.expected, start);
    const TrackingResult actual = device_tracker.track(views.actual, start);
    REQUIRE(translation_distance_m(actual.world_from_camera, expected.world_from_camera) < test::kPoseTolerance_m);
    REQUIRE(rotation_distance_rad(actual.world_from_camera, expected.world_from_camera) < test::kPoseTolerance_rad);
    REQUIRE(actual.measures.well_posed == expected.measures.well_posed);
    REQUIRE(std::abs(actual.measures.inlier_fraction - expected.measures.inlier_fraction) < 0.01F);
    REQUIRE(std::abs(actual.measures.residual_m - expected.measures.residual_m) < 0.001F);
    REQUIRE(std::abs(actual.num_mapped - expected.num_mapped) <= expected.num_valid / 100);
    REQUIRE(std::abs(actual.measures.log_det_total - expected.measures.log_det_total) < 0.05F);
  }
}

TEST_CASE("CUDA: tracking by depth and greys gives the CPU's poses") {
  const TwoViews views;
  const SE3& start = views.camera.world_from_camera;
  Random random = test::test_random();
  const RgbdFrame frame = test::render(test::Scene{}, start * test::random_motion(random, 0.03F, 0.02F), 160, 120);
  FrameUploader uploader(views.device);
  const auto track = [&](const Context& context, const Frame& seen, const SurfaceMap& map) {
    IcpTracker tracker(context, {2, 0});
    tracker.set_frame(seen);
    tracker.align_all(map, Array<SE3>(context.memory(), Span<const SE3>(&start, 1)), IcpResiduals::kDepthAndGrey);
    return tracker.world_from_cameras().to_host(context).front();
  };
  const SE3 expected = track(views.host, frame.view(), views.expected);
  const SE3 actual = track(views.device, uploader.upload(frame.view()), views.actual);
  REQUIRE(translation_distance_m(expected, *frame.world_from_camera) < 0.005F);
  REQUIRE(translation_distance_m(actual, expected) < test::kPoseTolerance_m);
  REQUIRE(rotation_distance_rad(actual, expected) < test::kPoseTolerance_rad);
}

TEST_CASE("CUDA: comparing views finds the CPU's agreement") {
  const RgbdFrame frame = test::render(test::Scene{}, test::pose_on_arc(0.45F), 160, 120);
  std::vector<ViewAgreement> agreements;
  for (const Device device : {Device::kCpu, Device::kCuda}) {
    const Context context = test::context_on(device);
    const TsdfVolume map = map_on(context, 3);
    SurfaceMap view(context.memory());
    Raycaster(context).render(map, test::camera_of(frame).reduced(2), view, true);
    FrameUploader uploader(context);
    ViewComparer comparer(context);
    comparer.set_frame(uploader.upload(frame.view()));
    agreements.push_back(comparer.compare(view, *frame.world_from_camera));
  }
  constexpr float kTolerance = 2e-3F;  // a pixel or two of a thousand
  REQUIRE(agreements[0].overlap > 0.5F);
  REQUIRE(std::abs(agreements[1].overlap - agreements[0].overlap) < kTolerance);
  REQUIRE(std::abs(agreements[1].agreement - agreements[0].agreement) < kTolerance);
  REQUIRE(std::abs(agreements[1].in_front - agreements[0].in_front) < kTolerance);
  REQUIRE(std::abs(agreements[1].behind - agreements[0].behind) < kTolerance);
  REQUIRE(std::abs(agreements[1].difference - agreements[0].difference) < kTolerance);
  REQUIRE(std::abs(agreements[1].colour_correlation - agreements[0].colour_correlation) < kTolerance);
}

TEST_CASE("CUDA: candidates refined in one batch end where the CPU's end, with its scores and decisions") {
  const RgbdFrame frame = test::render(test::Scene{}, test::pose_on_arc(0.45F), 160, 120);
  PoseRefinerSettings settings;  // for images of a quarter of a camera's size
  settings.coarse_divisor = 2;
  Random random = test::test_random();
  const auto sees_nothing = [](float x) { return PoseEstimate{test::look_at({x, 0.0F, 20.0F}, {x, 0.0F, 30.0F}), 0.5F}; };
  std::vector<PoseEstimate> near = {sees_nothing(0.0F)};
  for (int i = 0; i < 4; ++i) near.push_back({*frame.world_from_camera * test::random_motion(random, 0.15F, 0.15F), 0.5F});
  const std::vector<PoseEstimate> hopeless = {sees_nothing(1.0F), sees_nothing(2.0F)};
  std::vector<std::vector<RefinedPose>> results;
  for (const Device device : {Device::kCpu, Device::kCuda}) {
    const Context context = test::context_on(device);
    const TsdfVolume map = map_on(context, 3);
    FrameUploader uploader(context);
    PoseRefiner refiner(context, settings);
    const Frame uploaded = uploader.upload(frame.view());
    results.push_back(refiner.refine(uploaded, map, near));
    const std::vector<RefinedPose> refused = refiner.refine(uploaded, map, hopeless);
    REQUIRE(refused.size() == hopeless.size());
    for (const RefinedPose& pose : refused) REQUIRE_FALSE(pose.accepted);
  }
  constexpr float kScoreTolerance = 0.05F;
  REQUIRE_FALSE(results[0].empty());
  REQUIRE(results[0].front().accepted);
  REQUIRE(results[1].size() == results[0].size());
  for (std::size_t i = 0; i < results[0].size(); ++i) {
    const RefinedPose& expected = results[0][i];
    const RefinedPose& actual = results[1][i];
    INFO("finalist " << i << ", candidate " << expected.candidate);
    REQUIRE(actual.candidate == expected.candidate);
    REQUIRE(actual.accepted == expected.accepted);
    REQUIRE((actual.score == expected.score || std::abs(actual.score - expected.score) < kScoreTolerance));  // minus infinity is equal
    REQUIRE(translation_distance_m(actual.world_from_camera, expected.world_from_camera) < test::kPoseTolerance_m);
    REQUIRE(rotation_distance_rad(actual.world_from_camera, expected.world_from_camera) < test::kPoseTolerance_rad);
  }
}

TEST_CASE("CUDA: the pipeline tracks, grades and fuses as the CPU's does, on whatever device") {
  const int cuda_device = cuda_available(nullptr, 1) ? GENERATE(0, 1) : 0;
  FusionSettings settings;
  settings.volume = coarse();
  settings.render_divisor = 1;
  std::vector<std::vector<FusionFrameResult>> results(2);
  std::vector<int> num_blocks;
  for (const Device device : {Device::kCpu, Device::kCuda}) {
    const Context context = test::context_on(device, 1, device == Device::kCuda ? cuda_device : 0);
    FrameUploader uploader(context);
    FusionPipeline pipeline(context, settings, nullptr);
    pipeline.start_at(test::pose_on_arc(0.3F));
    for (int i = 0; i < 4; ++i) {
      const RgbdFrame frame = test::render(test::Scene{}, test::pose_on_arc(0.3F + 0.02F * static_cast<float>(i)), 160, 120);
      results[device == Device::kCpu ? 0 : 1].push_back(pipeline.process(uploader.upload(frame.view())));
    }
    num_blocks.push_back(pipeline.volume().num_blocks());
  }
  for (std::size_t i = 0; i < 4; ++i) {
    INFO("frame " << i);
    const FusionFrameResult& expected = results[0][i];
    const FusionFrameResult& actual = results[1][i];
    REQUIRE(actual.state == expected.state);
    REQUIRE(actual.quality == expected.quality);
    REQUIRE(actual.fused == expected.fused);
    REQUIRE(actual.world_from_camera.has_value() == expected.world_from_camera.has_value());
    if (!expected.world_from_camera) continue;
    REQUIRE(translation_distance_m(*actual.world_from_camera, *expected.world_from_camera) < test::kPoseTolerance_m);
    REQUIRE(rotation_distance_rad(*actual.world_from_camera, *expected.world_from_camera) < test::kPoseTolerance_rad);
  }
  REQUIRE(results[0][3].world_from_camera.has_value());
  REQUIRE(std::abs(num_blocks[1] - num_blocks[0]) <= num_blocks[0] / 50);
}

}  // namespace
}  // namespace foothold

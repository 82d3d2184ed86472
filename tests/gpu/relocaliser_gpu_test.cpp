// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// The relocaliser on CUDA against the same on the CPU.
#include <sstream>
#include <vector>

#include "features/leaf_lookup.h"
#include "foothold/base/error.h"
#include "foothold/base/random.h"
#include "foothold/frames/frame_uploader.h"
#include "foothold/relocalisation/forest_relocaliser.h"
#include "gpu/device.h"
#include "relocalisation/scenes.h"
#include "support/catch.h"
#include "support/random_seed.h"

namespace foothold {
namespace {

/// For the same reason as test::kPoseTolerance_m.
constexpr float kConfidenceTolerance = 0.02F;

/// A relocaliser on a device, fed from the host.
struct Rig {
  explicit Rig(Device device, const ForestRelocaliserSettings& settings, int cuda_device = 0)
      : context(test::context_on(device, 1, cuda_device)), uploader(context), relocaliser(context, test::small_forest(), settings) {}

  void train(std::size_t i) { relocaliser.train(uploader.upload(test::office()[i].view()), *test::office()[i].world_from_camera); }
  std::vector<PoseEstimate> relocalise(std::size_t i) { return relocaliser.relocalise(uploader.upload(test::office()[i].view())); }

  Context context;
  FrameUploader uploader;
  ForestRelocaliser relocaliser;
};

/// Small enough for the emulated device.
ForestRelocaliserSettings quick_settings() {
  ForestRelocaliserSettings settings = test::small_settings();
  settings.clustering.leaves_per_frame = 160;
  settings.clustering.min_cluster_size = 4;
  settings.pose.num_hypotheses = 128;
  settings.pose.pool_size = 1500;
  return settings;
}

TEST_CASE("CUDA: pixels reach the same leaves") {
  const Context host = test::context_on(Device::kCpu);
  const Context device = test::context_on(Device::kCuda);
  const Forest forest = test::small_forest();
  const auto view_in = [&](const Array<ForestFeature>& features, const Array<ForestNode>& nodes, const Array<std::int32_t>& roots) {
    return ForestView{features.data(), nodes.data(), roots.data(), forest.num_trees(), forest.num_leaves()};
  };
  Random random = test::test_random();
  std::vector<SampledPixel> pixels(3001);
  const RgbdFrame& frame = test::office()[3];
  for (SampledPixel& pixel : pixels) {
    const auto u = static_cast<int>(random.below(static_cast<std::uint32_t>(frame.depth.width())));
    const auto v = static_cast<int>(random.below(static_cast<std::uint32_t>(frame.depth.height())));
    pixel = {static_cast<std::int16_t>(u), static_cast<std::int16_t>(v), frame.depth(u, v)};
  }
  std::vector<std::vector<std::uint32_t>> leaves;
  for (const Context& context : {host, device}) {
    FrameUploader uploader(context);
    FeatureImage image(context);
    image.compute(context, uploader.upload(frame.view()), 2);
    const Array<ForestFeature> features(context.memory(), Span<const ForestFeature>(forest.features()));
    const Array<ForestNode> nodes(context.memory(), Span<const ForestNode>(forest.nodes()));
    const Array<std::int32_t> roots(context.memory(), Span<const std::int32_t>(forest.roots()));
    const Array<SampledPixel> sampled(context.memory(), Span<const SampledPixel>(pixels));
    Array<std::uint32_t> found(context.memory(), pixels.size() * static_cast<std::size_t>(forest.num_trees()));
    find_leaves(context, image, view_in(features, nodes, roots), Span<const SampledPixel>(sampled), Span<std::uint32_t>(found));
    leaves.push_back(found.to_host(context));
  }
  REQUIRE(leaves[0] == leaves[1]);
}

TEST_CASE("CUDA: reservoirs and modes are the CPU's, bit by bit") {
  for (const bool touched_first : {true, false}) {
    ForestRelocaliserSettings settings = quick_settings();
    settings.clustering.touched_first = touched_first;
    settings.reservoirs.capacity = touched_first ? 256 : 32;  // small ones replace what they hold
    Rig host(Device::kCpu, settings);
    Rig device(Device::kCuda, settings);
    for (std::size_t i = 0; i < 16; i += 4) {
      host.train(i);
      device.train(i);
    }
    host.relocaliser.update();
    device.relocaliser.update();
    const std::string expected = test::saved(host.relocaliser);
    REQUIRE(expected.size() > 10000);
    REQUIRE((test::saved(device.relocaliser) == expected));
    REQUIRE(device.relocaliser.state_bytes() == host.relocaliser.state_bytes());
  }
}

TEST_CASE("CUDA: memory_budget_mb leaves out what it does on the CPU") {
  ForestRelocaliserSettings settings = quick_settings();
  settings.memory_budget_mb = 1;
  Rig host(Device::kCpu, settings);
  Rig device(Device::kCuda, settings);
  settings.memory_budget_mb = 0;
  Rig unbounded(Device::kCpu, settings);
  for (std::size_t i = 0; i < 24; i += 3) {
    for (Rig* rig : {&host, &device, &unbounded}) rig->train(i);
  }
  REQUIRE((test::saved(device.relocaliser) == test::saved(host.relocaliser)));
  REQUIRE(host.relocaliser.state_bytes() <= 1000000);
  REQUIRE(unbounded.relocaliser.state_bytes() > host.relocaliser.state_bytes());
}

TEST_CASE("CUDA: poses are the CPU's to a millimetre and a milliradian") {
  Rig host(Device::kCpu, quick_settings());
  Rig device(Device::kCuda, quick_settings());
  for (std::size_t i = 0; i < 16; i += 2) host.train(i);
  std::stringstream scene(test::saved(host.relocaliser));
  device.relocaliser.load(scene);
  int num_found = 0;
  for (std::size_t i = 1; i < 16; i += 4) {
    INFO("frame " << i);
    const std::vector<PoseEstimate> expected = host.relocalise(i);
    const std::vector<PoseEstimate> actual = device.relocalise(i);
    REQUIRE(actual.size() == expected.size());
    if (expected.empty()) continue;
    ++num_found;
    REQUIRE(translation_distance_m(actual[0].world_from_camera, expected[0].world_from_camera) < test::kPoseTolerance_m);
    REQUIRE(rotation_distance_rad(actual[0].world_from_camera, expected[0].world_from_camera) < test::kPoseTolerance_rad);
    REQUIRE(std::abs(actual[0].confidence - expected[0].confidence) < kConfidenceTolerance);
    REQUIRE(translation_distance_m(actual[0].world_from_camera, *test::office()[i].world_from_camera) < 0.05F);
  }
  REQUIRE(num_found == 4);
}

TEST_CASE("CUDA: another device than the first learns and finds the same") {
  if (!cuda_available(nullptr, 1)) return;  // a machine with one device
  Rig first(Device::kCuda, quick_settings());
  Rig second(Device::kCuda, quick_settings(), 1);
  for (Rig* rig : {&first, &second}) {
    for (std::size_t i = 0; i < 16; i += 4) rig->train(i);
    rig->relocaliser.update();
  }
  REQUIRE((test::saved(first.relocaliser) == test::saved(second.relocaliser)));
  const ForestRelocaliser copy = second.relocaliser;
  REQUIRE((test::saved(copy) == test::saved(second.relocaliser)));
  const std::vector<PoseEstimate> expected = first.relocalise(1);
  const std::vector<PoseEstimate> actual = second.relocalise(1);
  REQUIRE_FALSE(expected.empty());
  REQUIRE(actual.size() == expected.size());
  REQUIRE(translation_distance_m(actual[0].world_from_camera, expected[0].world_from_camera) < test::kPoseTolerance_m);
}

TEST_CASE("CUDA: a frame in the memory of another device is refused") {
  if (!cuda_available(nullptr, 1)) return;  // a machine with one device
  Rig first(Device::kCuda, quick_settings());
  Rig second(Device::kCuda, quick_settings(), 1);
  const Frame elsewhere = second.uploader.upload(test::office()[0].view());
  REQUIRE_THROWS_AS(first.relocaliser.relocalise(elsewhere), ContractViolation);
}

TEST_CASE("CUDA: the paper's settings give the CPU's poses") {
  // The preset but for its sizes, which are more than the emulated device has the patience for.
  ForestRelocaliserSettings settings = ForestRelocaliserSettings::preset("paper");
  settings.reservoirs.capacity = 128;
  settings.clustering.leaves_per_frame = 512;
  settings.pose.pool_size = 1500;
  settings.pose.num_hypotheses = 64;
  Rig host(Device::kCpu, settings);
  for (std::size_t i = 0; i < 16; ++i) host.train(i % 8);
  Rig device(Device::kCuda, settings);
  std::stringstream scene(test::saved(host.relocaliser));
  device.relocaliser.load(scene);
  const std::vector<PoseEstimate> expected = host.relocalise(3);
  const std::vector<PoseEstimate> actual = device.relocalise(3);
  REQUIRE_FALSE(expected.empty());
  REQUIRE(actual.size() == expected.size());
  REQUIRE(translation_distance_m(actual[0].world_from_camera, expected[0].world_from_camera) < test::kPoseTolerance_m);
  REQUIRE(rotation_distance_rad(actual[0].world_from_camera, expected[0].world_from_camera) < test::kPoseTolerance_rad);
}

TEST_CASE("CUDA: blank depth teaches and finds nothing, and reset forgets") {
  Rig device(Device::kCuda, quick_settings());
  RgbdFrame blank = test::office()[0];
  std::fill(blank.depth.data(), blank.depth.data() + blank.depth.size(), -1.0F);
  device.relocaliser.train(device.uploader.upload(blank.view()), SE3{});
  REQUIRE(device.relocaliser.relocalise(device.uploader.upload(blank.view())).empty());
  device.train(0);
  device.relocaliser.reset();
  REQUIRE(device.relocalise(0).empty());
  Rig fresh(Device::kCuda, quick_settings());
  REQUIRE((test::saved(device.relocaliser) == test::saved(fresh.relocaliser)));
}

TEST_CASE("CUDA: copies of a relocaliser are independent") {
  Rig device(Device::kCuda, quick_settings());
  device.train(0);
  const std::string before = test::saved(device.relocaliser);
  ForestRelocaliser copy = device.relocaliser;
  REQUIRE((test::saved(copy) == before));
  copy.train(device.uploader.upload(test::office()[4].view()), *test::office()[4].world_from_camera);
  REQUIRE((test::saved(device.relocaliser) == before));
  REQUIRE_FALSE((test::saved(copy) == before));
}

}  // namespace
}  // namespace foothold

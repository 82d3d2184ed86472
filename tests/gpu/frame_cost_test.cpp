// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// What a frame costs beside its kernels, counted on the emulated device: nothing is allocated, and the host waits for results alone.
#include <algorithm>
#include <vector>

#include "foothold/frames/frame_uploader.h"
#include "foothold/fusion/fusion_pipeline.h"
#include "fusion/scene.h"
#include "gpu/device.h"
#include "relocalisation/scenes.h"
#include "reservoirs/block_lists.h"
#include "support/catch.h"
#include "support/emulated_cuda/emulated_cuda.h"
#include "support/random_seed.h"

namespace foothold {
namespace {

using test::EmulatedCuda;

/// The most launches of verbs with the default numbers of steps, rounds and trees: the table in docs/cuda.md.
/// Training: 5 tell new examples from known ones, before anything is learnt, and colour what is kept; the modes are updated twice.
constexpr int kLaunchesOfTraining = 30;
constexpr int kLaunchesOfRelocalisation = 6;  // 3 of them count the votes for places
constexpr int kLaunchesOfView = 63;           // that is tried; 3 of them confront its pose with the scene
constexpr int kLaunchesOfTrial = 17;          // of a view that seems unfamiliar, before it is tried
constexpr int kLaunchesOfFusion = 63;
constexpr int kLaunchesOfRefinement = 159;

ForestRelocaliserSettings few_leaves(int num_rolls) {
  ForestRelocaliserSettings settings = test::small_settings();
  settings.num_rolls = num_rolls;
  settings.sure_confidence = 1.0F;  // every roll is tried
  settings.clustering.leaves_per_frame = 40;
  settings.reservoirs.examples_per_view = 32;  // memory has grown after a frame
  settings.pose.num_hypotheses = 32;
  settings.pose.pool_size = 600;
  return settings;
}

TEST_CASE(
    "frame cost: training allocates nothing and waits once, for the number of examples that are new, and relocalising waits once for each "
    "view that is tried, and for each count of votes") {
  const int num_rolls = GENERATE(1, 3);
  const Context context = test::context_on(Device::kCuda);
  FrameUploader uploader(context);
  ForestRelocaliser relocaliser(context, test::small_forest(), few_leaves(num_rolls));
  const auto train = [&](std::size_t i) {
    relocaliser.train(uploader.upload(test::office()[i].view()), *test::office()[i].world_from_camera);
  };
  const auto relocalise = [&](std::size_t i) { return relocaliser.relocalise(uploader.upload(test::office()[i].view())); };
  train(0);
  relocalise(1);
  context.synchronise();

  EmulatedCuda& device = EmulatedCuda::instance();
  device.reset_counts();
  train(2);
  relocaliser.update();
  REQUIRE(device.counts().num_allocations == 0);
  REQUIRE(device.counts().num_frees == 0);
  REQUIRE(device.counts().num_waits == 2);  // update() asks whether anything is left to do
  REQUIRE(device.counts().num_device_waits == 0);
  REQUIRE(device.counts().num_writes == 2);  // depth and colour
  INFO("training with an update: " << device.counts().num_launches << " launches");
  REQUIRE(device.counts().num_launches <= kLaunchesOfTraining);

  device.reset_counts();
  relocalise(3);
  REQUIRE(device.counts().num_allocations == 0);
  REQUIRE(device.counts().num_frees == 0);
  const int num_screened = num_rolls - 1;
  const int num_counts = 1 + (num_screened > 0 ? 1 : 0);
  REQUIRE(device.counts().num_waits > num_counts);
  REQUIRE(device.counts().num_waits <= num_counts + num_rolls);
  REQUIRE(device.counts().num_reads == device.counts().num_waits);
  REQUIRE(device.counts().num_device_waits == 0);
  const int num_launches_of_rolled_votes = num_screened > 0 ? num_screened + 1 : 0;  // leaves for each, then one for all
  INFO("relocalising: " << device.counts().num_launches << " launches");
  REQUIRE(device.counts().num_launches <=
          kLaunchesOfRelocalisation + num_rolls * (kLaunchesOfTrial + kLaunchesOfView) + num_launches_of_rolled_votes);
}

TEST_CASE("frame cost: asking for the size of the scene waits for the stream alone") {
  const Context context = test::context_on(Device::kCuda);
  FrameUploader uploader(context);
  ForestRelocaliser relocaliser(context, test::small_forest(), few_leaves(1));
  relocaliser.train(uploader.upload(test::office()[0].view()), *test::office()[0].world_from_camera);  // a place to remember it
  EmulatedCuda& device = EmulatedCuda::instance();
  device.reset_counts();
  REQUIRE(relocaliser.state_bytes() > 0);
  REQUIRE(device.counts().num_waits == 2);  // for reservoirs and for modes
  REQUIRE(device.counts().num_device_waits == 0);
}

TEST_CASE("BlockLists: on CUDA the pool is reserved once, and kept when the lists are cleared") {
  const Context context = test::context_on(Device::kCuda);
  EmulatedCuda& device = EmulatedCuda::instance();
  device.reset_counts();
  BlockLists<int, 4> lists(context.memory(), 10, 100);
  REQUIRE(device.counts().num_allocations == 3);  // pool, table, counter
  const int* const pool = lists.view().pool;
  lists.clear();
  REQUIRE(device.counts().num_allocations == 3);
  REQUIRE(device.counts().num_frees == 0);
  REQUIRE(lists.view().pool == pool);
}

/// A pipeline for images of a quarter of a camera's size, with a map that the emulated device has the patience for.
FusionSettings small_fusion() {
  FusionSettings settings;
  settings.volume.voxel_size_m = 0.04F;
  settings.volume.truncation_m = 0.12F;
  settings.render_divisor = 1;
  settings.refiner.coarse_divisor = 4;
  return settings;
}

TEST_CASE("frame cost: a fused frame allocates nothing and waits twice, for its pose and for the number of new blocks") {
  const Context context = test::context_on(Device::kCuda);
  FrameUploader uploader(context);
  FusionPipeline pipeline(context, small_fusion(), nullptr);
  pipeline.start_at(test::pose_on_arc(0.3F));
  const auto frame_at = [](int i) {
    return test::render(test::Scene{}, test::pose_on_arc(0.3F + 0.02F * static_cast<float>(i)), 160, 120);
  };
  for (int i = 0; i < 2; ++i) pipeline.process(uploader.upload(frame_at(i).view()));
  const int num_blocks = pipeline.volume().num_blocks();

  EmulatedCuda& device = EmulatedCuda::instance();
  device.reset_counts();
  const FusionFrameResult result = pipeline.process(uploader.upload(frame_at(2).view()));
  REQUIRE(result.fused);
  REQUIRE(pipeline.volume().num_blocks() > num_blocks);
  REQUIRE(device.counts().num_allocations == 0);
  REQUIRE(device.counts().num_frees == 0);
  REQUIRE(device.counts().num_waits == 2);
  REQUIRE(device.counts().num_device_waits == 0);
  REQUIRE(device.counts().num_writes == 4);  // depth, colour, the guess, the pose to render from
  INFO("a fused frame: " << device.counts().num_launches << " launches");
  REQUIRE(device.counts().num_launches <= kLaunchesOfFusion);
}

TEST_CASE("frame cost: a lost frame without depth waits once, to be told so, and asks nobody") {
  const Context context = test::context_on(Device::kCuda);
  FrameUploader uploader(context);
  FusionPipeline pipeline(context, small_fusion(), nullptr);
  RgbdFrame frame = test::render(test::Scene{}, test::pose_on_arc(0.3F), 160, 120);
  pipeline.process(uploader.upload(frame.view()));
  std::fill_n(frame.depth.data(), frame.depth.size(), 0.0F);
  const Frame dark = uploader.upload(frame.view());
  pipeline.process(dark);
  REQUIRE(pipeline.state() == RecoveryState::kLost);

  EmulatedCuda& device = EmulatedCuda::instance();
  device.reset_counts();
  pipeline.process(dark);
  REQUIRE(device.counts().num_allocations == 0);
  REQUIRE(device.counts().num_waits == 1);
  REQUIRE(device.counts().num_launches <= 5);
}

TEST_CASE("frame cost: refining 16 candidates allocates nothing and waits twice, once for all of them and once for the finalists") {
  const Context context = test::context_on(Device::kCuda);
  const FusionSettings settings = small_fusion();
  FrameUploader uploader(context);
  TsdfVolume volume(context, settings.volume);
  const RgbdFrame recorded = test::render(test::Scene{}, test::pose_on_arc(0.45F), 160, 120);
  volume.integrate(uploader.upload(recorded.view()), *recorded.world_from_camera);
  Random random = test::test_random();
  std::vector<PoseEstimate> proposals;
  while (proposals.size() < 16) proposals.push_back({*recorded.world_from_camera * test::random_motion(random, 0.3F, 0.3F), 0.5F});
  PoseRefiner refiner(context, settings.refiner);
  const Frame frame = uploader.upload(recorded.view());
  const std::vector<RefinedPose> first = refiner.refine(frame, volume, proposals);

  EmulatedCuda& device = EmulatedCuda::instance();
  device.reset_counts();
  const std::vector<RefinedPose> second = refiner.refine(frame, volume, proposals);
  REQUIRE(second.size() == first.size());
  REQUIRE(second.front().accepted);
  REQUIRE(device.counts().num_allocations == 0);
  REQUIRE(device.counts().num_frees == 0);
  REQUIRE(device.counts().num_waits == 2);
  REQUIRE(device.counts().num_device_waits == 0);
  REQUIRE(device.counts().num_writes == 2);  // the candidates' poses, and the finalists'
  INFO("refining: " << device.counts().num_launches << " launches");
  REQUIRE(device.counts().num_launches <= kLaunchesOfRefinement);
}

}  // namespace
}  // namespace foothold

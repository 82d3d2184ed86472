// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// What a frame costs beside its kernels, counted on the emulated device: nothing is allocated, and the host waits for results alone.
#include <vector>

#include "foothold/api/frame_uploader.h"
#include "gpu/device.h"
#include "relocalisation/scenes.h"
#include "support/catch.h"
#include "support/emulated_cuda/emulated_cuda.h"

namespace foothold {
namespace {

using test::EmulatedCuda;

ForestRelocaliserSettings few_leaves(int num_rolls) {
  ForestRelocaliserSettings settings = test::small_settings();
  settings.num_rolls = num_rolls;
  settings.sure_confidence = 1.0F;  // every roll is tried
  settings.clustering.leaves_per_frame = 40;
  settings.pose.num_hypotheses = 32;
  settings.pose.pool_size = 600;
  return settings;
}

TEST_CASE("frame cost: training allocates nothing and never waits, relocalising waits once for each roll, for its result") {
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
  REQUIRE(device.counts().num_waits == 0);
  REQUIRE(device.counts().num_device_waits == 0);
  REQUIRE(device.counts().num_writes == 2);  // depth and colour
  INFO("training with an update: " << device.counts().num_launches << " launches");
  REQUIRE(device.counts().num_launches < 40);

  device.reset_counts();
  relocalise(3);
  REQUIRE(device.counts().num_allocations == 0);
  REQUIRE(device.counts().num_frees == 0);
  REQUIRE(device.counts().num_waits == num_rolls);
  REQUIRE(device.counts().num_reads == num_rolls);
  REQUIRE(device.counts().num_device_waits == 0);
  INFO("relocalising: " << device.counts().num_launches << " launches");
  REQUIRE(device.counts().num_launches < 80 * num_rolls);
}

}  // namespace
}  // namespace foothold

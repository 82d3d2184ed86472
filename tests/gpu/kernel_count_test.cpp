// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// How many kernels CUDA is asked to launch, those of CUB included: nvcc's own code, launching on a fake of the CUDA runtime. The table in
/// docs/cuda.md, and what is known of the worth of CUDA graphs.
#include <cstdint>
#include <cstring>

#include "foothold/frames/frame_uploader.h"
#include "foothold/relocalisation/forest_relocaliser.h"
#include "foothold/synthetic/synthetic_sequence.h"
#include "gpu/device.h"
#include "support/catch.h"
#include "support/fake_cuda_runtime/fake_cuda_runtime.h"

namespace foothold {
namespace {

/// The most that is asked of the device for a frame of a camera with the default forest and settings: kernels, and copies and clears.
/// Training includes an update. 11 of its kernels and 8 of the others tell new examples from known ones and colour them: a sort of 29 bits
/// takes 6 and 6.
constexpr int kKernelsOfTraining = 37;
constexpr int kOthersOfTraining = 19;
constexpr int kKernelsOfUpdate = 13;
constexpr int kOthersOfUpdate = 7;            // one of them asks whether any leaf had changed
constexpr int kKernelsOfRelocalisation = 70;  // upright; 3 of them count the votes for places
constexpr int kOthersOfRelocalisation = 13;
constexpr int kKernelsOfOtherLights = 17;  // an unfamiliar view's votes in four lights, 4 each, and the voters of the one that counts
constexpr int kOthersOfOtherLights = 8;
constexpr int kKernelsOfTrial = 18;  // of an unfamiliar view, before it is tried
constexpr int kOthersOfTrial = 5;
constexpr int kOthersOfRolledVotes = 2;  // beside a kernel for each roll but the upright one, and one for all

constexpr std::uint32_t kNumExamples = 4800;  // of 640 x 480 pixels, every eighth in each direction

/// What the device says of a frame's examples: how many are to be learnt, how many entries that makes of the place's views, and how many
/// lie beyond its reach.
void new_examples(void* host, std::size_t num_bytes) {
  constexpr std::uint32_t kCounts[3] = {kNumExamples, 0, 0};
  if (num_bytes == sizeof(kCounts)) std::memcpy(host, kCounts, num_bytes);
}

/// Checks what was asked of the device since the last call.
void require_at_most(const char* call, int num_kernels, int num_others) {
  test::FakeCudaRuntime& cuda = test::FakeCudaRuntime::instance();
  const int copies_and_clears = cuda.calls["cudaMemcpyAsync"] + cuda.calls["cudaMemsetAsync"];
  INFO(call << ": " << cuda.launches.size() << " kernels, " << copies_and_clears << " copies and clears");
  REQUIRE(static_cast<int>(cuda.launches.size()) <= num_kernels);
  REQUIRE(copies_and_clears <= num_others);
  REQUIRE(cuda.calls["cudaDeviceSynchronize"] == 0);
  cuda.launches.clear();
  cuda.calls.clear();
}

TEST_CASE("CUDA runtime: a frame takes no more kernels than docs/cuda.md says") {
  test::FakeCudaRuntime::instance().reset();
  const RgbdFrame recorded = make_synthetic_sequence(parse_synthetic_spec("synthetic:office?frames=1&noise=0"), Context{})->load(0);
  const Context context = test::context_on(Device::kCuda);
  FrameUploader uploader(context);
  const Frame frame = uploader.upload(recorded.view());
  ForestRelocaliserSettings settings;
  const int num_rolls = GENERATE(1, 8);
  settings.num_rolls = num_rolls;
  ForestRelocaliser relocaliser(context, default_forest(), settings);
  test::FakeCudaRuntime& cuda = test::FakeCudaRuntime::instance();
  const auto train = [&] {
    cuda.answer = new_examples;
    relocaliser.train(frame, *recorded.world_from_camera);
    cuda.answer = nullptr;
  };
  train();  // makes a place, and room
  relocaliser.relocalise(frame);
  context.synchronise();
  cuda.launches.clear();
  cuda.calls.clear();

  train();
  require_at_most("training", kKernelsOfTraining, kOthersOfTraining);
  relocaliser.update();
  require_at_most("update", kKernelsOfUpdate, kOthersOfUpdate);
  relocaliser.relocalise(frame);  // kernels that do nothing find nothing, in no light: one view is tried, for the others votes are counted
  const bool has_rolls = num_rolls > 1;
  require_at_most("relocalisation", kKernelsOfRelocalisation + kKernelsOfOtherLights + kKernelsOfTrial + (has_rolls ? num_rolls : 0),
                  kOthersOfRelocalisation + kOthersOfOtherLights + kOthersOfTrial + (has_rolls ? kOthersOfRolledVotes : 0));
}

}  // namespace
}  // namespace foothold

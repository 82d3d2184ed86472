// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// How many kernels CUDA is asked to launch, those of CUB included: nvcc's own code, launching on a fake of the CUDA runtime. The table in
/// docs/cuda.md, and what is known of the worth of CUDA graphs.
#include "foothold/frames/frame_uploader.h"
#include "foothold/relocalisation/forest_relocaliser.h"
#include "foothold/synthetic/synthetic_sequence.h"
#include "gpu/device.h"
#include "support/catch.h"
#include "support/fake_cuda_runtime/fake_cuda_runtime.h"

namespace foothold {
namespace {

/// The most that is asked of the device for a frame of a camera with the default forest and settings: kernels, and copies and clears.
constexpr int kKernelsOfTraining = 26;
constexpr int kOthersOfTraining = 11;
constexpr int kKernelsOfUpdate = 13;
constexpr int kOthersOfUpdate = 6;
constexpr int kKernelsOfRoll = 69;
constexpr int kOthersOfRoll = 12;
constexpr int kKernelsOfScreening = 10;  // for each roll but the upright one
constexpr int kOthersOfScreening = 2;

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
  relocaliser.relocalise(frame);  // makes room
  context.synchronise();
  test::FakeCudaRuntime::instance().reset();

  relocaliser.train(frame, *recorded.world_from_camera);
  require_at_most("training", kKernelsOfTraining, kOthersOfTraining);
  relocaliser.update();
  require_at_most("update", kKernelsOfUpdate, kOthersOfUpdate);
  relocaliser.relocalise(frame);  // kernels that do nothing find nothing: one roll is tried, the others are screened
  require_at_most("relocalisation", kKernelsOfRoll + (num_rolls - 1) * kKernelsOfScreening,
                  kOthersOfRoll + (num_rolls - 1) * kOthersOfScreening);
}

}  // namespace
}  // namespace foothold

// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <optional>
#include <sstream>

#include "benchmark_frames.h"
#include "device_rig.h"
#include "foothold/base/trace.h"
#include "foothold/evaluation/pose_error.h"

namespace foothold::benchmark {
namespace {

/// Rounding moves poses by less; see docs/conventions.md.
constexpr double kTolerance_m = 1e-3;
constexpr double kTolerance_rad = 1e-3;
/// Where two candidates are about as good, rounding may decide between them.
constexpr double kMaxDeviating = 0.02;

struct Outcome {
  std::string scene;  ///< what the relocaliser has learnt, as it is saved
  std::vector<std::optional<SE3>> found;
  int num_right = 0;
  std::vector<std::optional<SE3>> tracked;
  int num_fused = 0;
  int num_blocks = 0;
};

Outcome run_on(Device device, const Options& options, const std::vector<RgbdFrame>& frames) {
  Options here = options;
  here.device = device;
  DeviceRig rig(make_context(here), options.preset);
  Outcome outcome;
  rig.pipeline.start_at(*frames[0].world_from_camera);
  for (std::size_t i = 0; i < frames.size(); ++i) {
    const Frame frame = rig.uploader.upload(frames[i].view());
    if (i % 2 == 0) rig.relocaliser.train(frame, *frames[i].world_from_camera);
    const FusionFrameResult result = rig.pipeline.process(frame);
    outcome.tracked.push_back(result.world_from_camera);
    outcome.num_fused += result.fused ? 1 : 0;
  }
  for (std::size_t i = 1; i < frames.size(); i += 2) {
    const std::vector<PoseEstimate> found = rig.relocaliser.relocalise(rig.uploader.upload(frames[i].view()));
    outcome.found.push_back(found.empty() ? std::nullopt : std::optional<SE3>(found[0].world_from_camera));
    if (!found.empty() && kFoundThreshold.contains(pose_error(found[0].world_from_camera, *frames[i].world_from_camera))) {
      ++outcome.num_right;
    }
  }
  std::ostringstream scene;
  rig.relocaliser.save(scene);
  outcome.scene = scene.str();
  outcome.num_blocks = rig.pipeline.volume().num_blocks();
  return outcome;
}

/// Prints how far poses of the two devices lie apart. @return whether nearly all of them are alike
bool compare_poses(const char* what, const std::vector<std::optional<SE3>>& expected, const std::vector<std::optional<SE3>>& actual) {
  std::vector<double> translations_m;
  std::vector<double> rotations_rad;
  std::size_t num_deviating = 0;
  for (std::size_t i = 0; i < expected.size(); ++i) {
    if (!expected[i] && !actual[i]) continue;
    PoseError error{std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
    if (expected[i] && actual[i]) error = pose_error(*actual[i], *expected[i]);
    translations_m.push_back(error.translation_m);
    rotations_rad.push_back(error.rotation_rad);
    num_deviating += error.translation_m < kTolerance_m && error.rotation_rad < kTolerance_rad ? 0 : 1;
  }
  std::printf(
      "| %s: distance, median / 95 %% / largest | %.4f / %.4f / %.4f mm | %.4f / %.4f / %.4f mrad | %zu of %zu beyond 1 mm or 1 mrad |\n",
      what, 1e3 * quantile(translations_m, 0.5), 1e3 * quantile(translations_m, 0.95), 1e3 * quantile(translations_m, 1.0),
      1e3 * quantile(rotations_rad, 0.5), 1e3 * quantile(rotations_rad, 0.95), 1e3 * quantile(rotations_rad, 1.0), num_deviating,
      translations_m.size());
  return static_cast<double>(num_deviating) <= kMaxDeviating * static_cast<double>(translations_m.size());
}

bool compare_counts(const char* what, int expected, int actual) {
  std::printf("| %s | %d | %d | |\n", what, expected, actual);
  return std::abs(expected - actual) <= std::max(1.0, kMaxDeviating * expected);
}

}  // namespace

bool compare_devices(const Options& options) {
  Options on_cuda = options;
  on_cuda.device = Device::kCuda;
  const std::string name = make_context(on_cuda).device_name();  // throws before anything is loaded
  const std::vector<RgbdFrame> frames = load_frames(options.sequence, options.num_frames, 2);
  const Outcome expected = run_on(Device::kCpu, options, frames);
  const Outcome actual = run_on(Device::kCuda, options, frames);
  std::printf("\n| %zu frames of %s | CPU | %s | |\n|---|---:|---:|---|\n", frames.size(), options.sequence.c_str(), name.c_str());
  const bool same_scene = actual.scene == expected.scene;
  std::printf("| scene, as saved [bytes] | %zu | %zu | %s |\n", expected.scene.size(), actual.scene.size(),
              same_scene ? "identical" : "DIFFERENT");
  bool all_alike = same_scene;
  all_alike &=
      compare_counts("found within 5 cm and 5 deg, every second frame learnt, the others asked", expected.num_right, actual.num_right);
  all_alike &= compare_poses("found", expected.found, actual.found);
  all_alike &= compare_counts("frames fused", expected.num_fused, actual.num_fused);
  all_alike &= compare_counts("blocks of the map", expected.num_blocks, actual.num_blocks);
  all_alike &= compare_poses("tracked", expected.tracked, actual.tracked);
  std::printf("%s\n", all_alike ? "alike" : "NOT ALIKE");
  return all_alike;
}

}  // namespace foothold::benchmark

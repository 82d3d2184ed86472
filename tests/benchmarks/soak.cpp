// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include <unistd.h>

#include <cstdio>
#include <cstring>
#include <fstream>

#include "benchmark_frames.h"
#include "device_rig.h"
#include "foothold/base/trace.h"

namespace foothold::benchmark {
namespace {

/// Memory of this process [MB].
double resident_mb() {
  std::ifstream statm("/proc/self/statm");
  double total_pages = 0.0;
  double resident_pages = 0.0;
  statm >> total_pages >> resident_pages;
  return 1e-6 * resident_pages * static_cast<double>(::sysconf(_SC_PAGESIZE));
}

/// A number that two laps share only if all their poses are the same, bit by bit.
class PoseHash {
 public:
  void add(const SE3& pose) {
    add_bytes(pose.rotation.data(), 9 * sizeof(float));
    add_bytes(pose.translation.data(), 3 * sizeof(float));
  }
  unsigned long long value() const { return value_; }

 private:
  void add_bytes(const float* values, std::size_t num_bytes) {
    unsigned char bytes[9 * sizeof(float)];
    std::memcpy(bytes, values, num_bytes);
    for (std::size_t i = 0; i < num_bytes; ++i) value_ = (value_ ^ bytes[i]) * 1099511628211ULL;  // FNV-1a
  }
  unsigned long long value_ = 14695981039346656037ULL;
};

struct Lap {
  unsigned long long hash = 0;
  double median_ms = 0.0;
  double slowest_ms = 0.0;
};

/// The recording once, from an empty scene: every tenth frame is asked for as well, and its candidates are refined.
Lap run_lap(DeviceRig& rig, const std::vector<RgbdFrame>& frames) {
  constexpr std::size_t kAskEvery = 10;
  rig.relocaliser.reset();
  rig.pipeline.reset();
  rig.pipeline.start_at(*frames[0].world_from_camera);
  PoseHash hash;
  std::vector<double> durations_ms;
  for (std::size_t i = 0; i < frames.size(); ++i) {
    const Stopwatch watch;
    const Frame frame = rig.uploader.upload(frames[i].view());
    if (i % kAskEvery == kAskEvery - 1) {
      const std::vector<PoseEstimate> proposals = rig.relocaliser.relocalise(frame);
      for (const PoseEstimate& proposal : proposals) hash.add(proposal.world_from_camera);
      for (const RefinedPose& refined : rig.refiner.refine(frame, rig.pipeline.volume(), proposals)) hash.add(refined.world_from_camera);
    }
    rig.relocaliser.train(frame, *frames[i].world_from_camera);
    const FusionFrameResult result = rig.pipeline.process(frame);
    if (result.world_from_camera) hash.add(*result.world_from_camera);
    rig.context.synchronise();
    durations_ms.push_back(watch.elapsed_ms());
  }
  return {hash.value(), quantile(durations_ms, 0.5), quantile(durations_ms, 1.0)};
}

}  // namespace

bool soak(const Options& options) {
  DeviceRig rig(make_context(options), options.preset);
  const std::vector<RgbdFrame> frames = load_frames(options.sequence, options.num_frames, 1);
  std::printf(
      "%s: %zu frames of %s again and again for %d s\n\n| lap | s | median [ms] | slowest [ms] | memory of the process [MB] | poses |\n"
      "|---:|---:|---:|---:|---:|---|\n",
      rig.context.device_name().c_str(), frames.size(), options.sequence.c_str(), options.num_seconds);
  const Stopwatch watch;
  Lap first;
  double settled_mb = 0.0;  // after the second lap, whose buffers have grown
  bool is_alike = true;
  constexpr int kMinLaps = 3;
  for (int number = 0; number < kMinLaps || watch.elapsed_ms() < 1e3 * options.num_seconds; ++number) {
    const Lap lap = run_lap(rig, frames);
    if (number == 0) first = lap;
    if (number == 1) settled_mb = resident_mb();
    is_alike &= lap.hash == first.hash;
    std::printf("| %d | %.1f | %.3f | %.3f | %.1f | %s |\n", number, 1e-3 * watch.elapsed_ms(), lap.median_ms, lap.slowest_ms,
                resident_mb(), lap.hash == first.hash ? "same" : "DIFFERENT");
    std::fflush(stdout);
  }
  constexpr double kGrowth_mb = 16.0;
  const bool has_grown = resident_mb() > settled_mb + kGrowth_mb;
  std::printf("%s%s\n", is_alike ? "all laps alike" : "LAPS DIFFER", has_grown ? ", MEMORY GROWS" : ", memory flat");
  return is_alike && !has_grown;
}

}  // namespace foothold::benchmark

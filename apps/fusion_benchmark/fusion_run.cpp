// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "fusion_run.h"

#include <ctime>
#include <numeric>

#include "common/peak_memory.h"
#include "foothold/frames/frame_uploader.h"

namespace foothold::apps {

namespace {
/// Processor time of all threads so far [ms].
double process_cpu_ms() {
  timespec time{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
  return 1e3 * static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_nsec);
}

void note(const RgbdFrame& frame, const FusionFrameResult& result, FusionRun& run) {
  ++run.num_frames;
  run.num_fused += result.fused ? 1 : 0;
  run.wall_ms.push_back(result.total_ms);
  if (!result.world_from_camera) {
    ++run.num_lost;
    return;
  }
  (result.quality == TrackingQuality::kGood ? run.num_good : run.num_poor) += 1;
  run.confidences.push_back(static_cast<double>(result.confidence));
  run.trajectory.push_back({frame.timestamp_s, *result.world_from_camera});
  if (!frame.world_from_camera) return;
  run.estimated.push_back(*result.world_from_camera);
  run.truth.push_back(*frame.world_from_camera);
}
}  // namespace

FusionRun run_fusion(const Context& context, Trace& trace, const Sequence& sequence, int stride, const FusionSettings& settings,
                     const std::function<bool(int)>& progress) {
  restart_peak_memory();
  FusionPipeline pipeline(context, settings, nullptr);
  FrameUploader uploader(context);
  FusionRun run;
  for (int i = 0; i < sequence.num_frames(); i += stride) {
    const RgbdFrame frame = sequence.load(i);
    if (i == 0 && frame.world_from_camera) pipeline.start_at(*frame.world_from_camera);
    trace.clear();
    const double before_ms = process_cpu_ms();
    const FusionFrameResult result = pipeline.process(uploader.upload(frame.view()));
    run.cpu_ms.push_back(process_cpu_ms() - before_ms);
    for (const auto& [stage, durations_ms] : trace.stages()) {
      run.stages_ms[stage].push_back(std::accumulate(durations_ms.begin(), durations_ms.end(), 0.0));
    }
    note(frame, result, run);
    if (!progress(run.num_frames)) break;
  }
  run.map_mb = 1e-6 * static_cast<double>(pipeline.volume().state_bytes());
  run.peak_mb = peak_memory_mb();
  return run;
}

namespace {
void add(const RefinedPose& refined, const SE3& truth, Ceiling& ceiling) {
  const double distance_m = translation_distance_m(refined.world_from_camera, truth);
  const double angle_deg = 57.29578 * rotation_distance_rad(refined.world_from_camera, truth);
  ceiling.num_within_5 += distance_m <= 0.05 && angle_deg <= 5.0 ? 1 : 0;
  ceiling.num_within_10 += distance_m <= 0.1 && angle_deg <= 10.0 ? 1 : 0;
  ceiling.num_accepted += refined.accepted ? 1 : 0;
  ceiling.distances_m.push_back(distance_m);
}
}  // namespace

CeilingRun run_ceiling(const Context& context, const Sequence& map, const Sequence& tested, int stride, const FusionSettings& settings,
                       const std::function<bool(int)>& progress) {
  TsdfVolume volume(context, settings.volume);
  int num_done = 0;
  for (int i = 0; i < map.num_frames(); i += stride) {
    const RgbdFrame frame = map.load(i);
    if (frame.world_from_camera) volume.integrate(frame.view(), *frame.world_from_camera);
    if (!progress(++num_done)) return {};
  }
  PoseRefiner refiner(context, settings.refiner, settings.volume.depth_range());
  CeilingRun run;
  for (int i = 0; i < tested.num_frames(); i += stride) {
    const RgbdFrame frame = tested.load(i);
    if (frame.world_from_camera) {
      const SE3& truth = *frame.world_from_camera;
      const PoseEstimate proposal{truth, 1.0F};
      ++run.num_frames;
      add(refiner.refine_one(frame.view(), volume, truth), truth, run.aligned);
      add(refiner.refine(frame.view(), volume, Span<const PoseEstimate>(&proposal, 1)).front(), truth, run.refined);
    }
    if (!progress(++num_done)) break;
  }
  return run;
}

}  // namespace foothold::apps

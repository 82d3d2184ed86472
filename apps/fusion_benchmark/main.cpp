// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// fusion_benchmark: how well, how fast and in how much memory the tracker follows a recording, without any relocaliser.
#include <algorithm>
#include <cstdio>

#include "common/app_main.h"
#include "common/json.h"
#include "common/override_settings.h"
#include "common/progress_bar.h"
#include "common/recording_options.h"
#include "foothold/base/atomic_file.h"
#include "foothold/base/error.h"
#include "foothold/evaluation/trajectory_error.h"
#include "foothold/io/sequence.h"
#include "fusion_run.h"

namespace foothold::apps {
namespace {

struct Options {
  std::vector<std::string> sequences;
  std::string map;
  int stride = 1;
  std::string settings_file;
  std::vector<std::string> assignments;
  std::string json_file;
  std::string trajectory_file;
  DeviceOptions device;
  SequenceOptions recording;
};

FusionSettings settings_of(const Options& options) {
  FusionSettings settings;
  apps::override_settings(options.settings_file, options.assignments, "setting=value", settings);
  return settings;
}

/// ATE and drift, where the truth is known.
struct Accuracy {
  AbsoluteTrajectoryError raw;
  AbsoluteTrajectoryError aligned;
  RelativePoseError drift;  ///< over kDriftFrames
};
constexpr int kDriftFrames = 30;

Accuracy accuracy_of(const FusionRun& run) {
  if (run.truth.empty()) return {};
  return {absolute_trajectory_error(run.estimated, run.truth, TrajectoryAlignment::kNone),
          absolute_trajectory_error(run.estimated, run.truth, TrajectoryAlignment::kRigid),
          relative_pose_error(run.estimated, run.truth, kDriftFrames)};
}

void print(const std::string& sequence, const FusionRun& run, const Accuracy& accuracy) {
  std::printf("%s: %d frames, %d good, %d poor, %d lost, %d fused\n", sequence.c_str(), run.num_frames, run.num_good, run.num_poor,
              run.num_lost, run.num_fused);
  if (!run.truth.empty()) {
    std::printf("  ATE RMSE %.2f cm raw, %.2f cm rigidly aligned (max %.2f); over %d frames %.2f cm, %.2f deg\n",
                100.0 * accuracy.raw.rmse_m, 100.0 * accuracy.aligned.rmse_m, 100.0 * accuracy.aligned.max_m, kDriftFrames,
                100.0 * accuracy.drift.translation_rmse_m, 57.29578 * accuracy.drift.rotation_rmse_rad);
  }
  std::printf("  confidence: median %.3f, 5 %% below %.3f, 1 %% below %.3f\n", quantile(run.confidences, 0.5),
              quantile(run.confidences, 0.05), quantile(run.confidences, 0.01));
  std::printf("  CPU ms per frame: median %.1f, 95 %% below %.1f; wall %.1f\n", quantile(run.cpu_ms, 0.5), quantile(run.cpu_ms, 0.95),
              quantile(run.wall_ms, 0.5));
  for (const auto& [stage, durations_ms] : run.stages_ms) std::printf("    %-18s %6.1f\n", stage.c_str(), quantile(durations_ms, 0.5));
  std::printf("  map %.0f MB, process at most %.0f MB\n", run.map_mb, run.peak_mb);
}

Json to_json(const std::string& sequence, const FusionRun& run, const Accuracy& accuracy) {
  Json json = {
      {"sequence", sequence},
      {"frames",
       {{"all", run.num_frames}, {"good", run.num_good}, {"poor", run.num_poor}, {"lost", run.num_lost}, {"fused", run.num_fused}}},
      {"cpu_ms", {{"median", quantile(run.cpu_ms, 0.5)}, {"p95", quantile(run.cpu_ms, 0.95)}}},
      {"wall_ms", {{"median", quantile(run.wall_ms, 0.5)}, {"p95", quantile(run.wall_ms, 0.95)}}},
      {"map_mb", run.map_mb},
      {"peak_mb", run.peak_mb},
      {"warnings", warnings()}};
  for (const auto& [stage, durations_ms] : run.stages_ms) json["stages_wall_ms"][stage] = quantile(durations_ms, 0.5);
  if (!run.truth.empty()) {
    json["ate_m"] = {{"raw", accuracy.raw.rmse_m}, {"aligned", accuracy.aligned.rmse_m}, {"aligned_max", accuracy.aligned.max_m}};
    json["drift_over_30_frames"] = {{"translation_m", accuracy.drift.translation_rmse_m},
                                    {"rotation_rad", accuracy.drift.rotation_rmse_rad}};
  }
  return json;
}

void print_ceiling(const char* name, const Ceiling& ceiling, int num_frames) {
  const double percent = 100.0 / std::max(1, num_frames);
  std::printf("  %s: %.1f %% within 5 cm / 5 deg, %.1f %% within 10 / 10, median %.1f mm; %.1f %% accepted\n", name,
              percent * ceiling.num_within_5, percent * ceiling.num_within_10, 1e3 * quantile(ceiling.distances_m, 0.5),
              percent * ceiling.num_accepted);
}

Json ceiling_json(const Ceiling& ceiling) {
  return {{"within_5cm_5deg", ceiling.num_within_5},
          {"within_10cm_10deg", ceiling.num_within_10},
          {"accepted", ceiling.num_accepted},
          {"median_m", quantile(ceiling.distances_m, 0.5)}};
}

/// Measures what alignment does to true poses.
int run_ceilings(const Options& options, const FusionSettings& settings) {
  const Context context = make_context(options.device);
  if (context.memory() != MemoryKind::kHost) throw InvalidSettings("--device: got cuda, expected cpu with --map");
  const std::shared_ptr<Sequence> map = open_sequence(options.map, context, options.recording);
  Json json = Json::array();
  for (const std::string& spec : options.sequences) {
    const std::shared_ptr<Sequence> tested = open_sequence(spec, context, options.recording);
    CeilingRun result;
    {
      ProgressBar bar(spec, (map->num_frames() + tested->num_frames()) / options.stride);
      result = run_ceiling(context, *map, *tested, options.stride, settings, [&](int done) {
        bar.set(done);
        return !interrupted();
      });
    }
    if (interrupted()) return kInterrupted;
    std::printf("%s on a map of %s, %d true poses:\n", spec.c_str(), options.map.c_str(), result.num_frames);
    print_ceiling("aligned", result.aligned, result.num_frames);
    print_ceiling("refined", result.refined, result.num_frames);
    json.push_back({{"map", options.map},
                    {"sequence", spec},
                    {"frames", result.num_frames},
                    {"aligned", ceiling_json(result.aligned)},
                    {"refined", ceiling_json(result.refined)}});
  }
  if (!options.json_file.empty()) write_file_atomically(options.json_file, json.dump() + "\n");
  return kSuccess;
}

int run(const Options& options) {
  const FusionSettings settings = settings_of(options);
  if (!options.map.empty()) return run_ceilings(options, settings);
  if (!options.trajectory_file.empty() && options.sequences.size() != 1) {
    throw InvalidSettings("--trajectory: got " + std::to_string(options.sequences.size()) + " sequences, expected one");
  }
  Json json = Json::array();
  for (const std::string& spec : options.sequences) {
    Trace trace;
    const Context context = make_context(options.device, &trace);
    const std::shared_ptr<Sequence> sequence = open_sequence(spec, context, options.recording);
    FusionRun result;
    {
      ProgressBar bar(spec, (sequence->num_frames() + options.stride - 1) / options.stride);
      result = run_fusion(context, trace, *sequence, options.stride, settings, [&](int done) {
        bar.set(done);
        return !interrupted();
      });
    }
    if (interrupted()) return kInterrupted;
    const Accuracy accuracy = accuracy_of(result);
    print(spec, result, accuracy);
    json.push_back(to_json(spec, result, accuracy));
    if (!options.trajectory_file.empty()) write_trajectory(options.trajectory_file, result.trajectory, sequence->origin_m());
  }
  if (!options.json_file.empty()) write_file_atomically(options.json_file, json.dump() + "\n");
  return kSuccess;
}

}  // namespace
}  // namespace foothold::apps

int main(int argc, char** argv) {
  using namespace foothold;
  using namespace foothold::apps;
  CommandLine app("Follows recordings with the tracker alone, from the first true pose, and reports accuracy, time and memory.",
                  "fusion_benchmark");
  Options options;
  app.add_option("--sequence", options.sequences, std::string(kRecordingHelp) + "; repeatable").required().repeatable();
  app.add_option("--map", options.map,
                 "Instead of tracking, fuse this recording with its true poses, and align the frames of each --sequence from theirs: the "
                 "ceiling of relocalisation with refinement");
  app.add_option("--stride", options.stride, "Use every Nth frame").range(1, 1000000).show_default();
  app.add_option("--settings", options.settings_file, "JSON file of settings").type_name("FILE");
  app.add_option("--set", options.assignments, "One setting as setting=value, such as volume.max_weight=100; repeatable").repeatable();
  app.add_option("--json", options.json_file, "Write the results to FILE").type_name("FILE");
  app.add_option("--trajectory", options.trajectory_file, "Write the trajectory to FILE, in the format of the TUM benchmark")
      .type_name("FILE");
  add_device_options(app, options.device);
  add_recording_options(app, options.recording);
  return run_app(app, argc, argv, [&] { return run(options); });
}

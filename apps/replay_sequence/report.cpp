// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "report.h"

#include <cmath>

#include "foothold/evaluation/text_table.h"

namespace foothold::replay {
namespace {

std::vector<std::string> run_row(const std::string& name, const ReplayRun& run) {
  const RunCounts counts = count_frames(run);
  const std::optional<RunError> error = run_error(run);
  const double nan = std::nan("");
  return {name,
          std::to_string(counts.num_frames),
          std::to_string(counts.num_lost),
          std::to_string(counts.num_fused),
          format_number(error.has_value() ? 100.0 * error->raw.rmse_m : nan, 2),
          format_number(error.has_value() ? 100.0 * error->aligned.rmse_m : nan, 2),
          format_number(static_cast<double>(counts.num_frames) / run.wall_s, 1),
          format_number(static_cast<double>(run.map_bytes) * kMb, 0),
          format_number(static_cast<double>(run.relocaliser_bytes) * kMb, 1)};
}

std::string run_table(const ReplayResult& result) {
  std::vector<std::vector<std::string>> rows = {run_row("undisturbed", result.undisturbed)};
  if (result.kidnapped.has_value()) rows.push_back(run_row("kidnapped", *result.kidnapped));
  return format_table({"run", "frames", "lost", "fused", "ATE cm", "aligned cm", "frames/s", "map MB", "relocaliser MB"}, rows);
}

std::string time_table(const ReplayRun& run) {
  std::vector<std::vector<std::string>> rows;
  for (const auto& [stage, spread] : stage_times(run)) {
    rows.push_back({stage, format_number(spread.median, 1), format_number(spread.p95, 1)});
  }
  return format_table({"ms per frame", "median", "p95"}, rows);
}

std::string kidnap_table(const ReplayResult& result) {
  std::vector<std::vector<std::string>> rows;
  for (const auto& [kind, summary] : kidnap_summaries(result)) {
    rows.push_back({kind, std::to_string(summary.num_kidnaps), std::to_string(summary.num_recovered),
                    std::to_string(summary.num_kidnaps_with_wrong_believed), std::to_string(summary.num_wrong),
                    std::to_string(summary.num_wrong_believed), std::to_string(summary.num_wrong_fused),
                    format_number(summary.median_frames, 1), format_number(summary.p95_frames, 1), format_number(summary.median_ms, 0)});
  }
  return format_table({"kidnaps", "number", "recovered", "resumed wrongly", "wrong poses", "believed", "fused", "frames to recovery", "p95",
                       "ms to recovery"},
                      rows);
}

std::string surface_table(const std::vector<SurfaceComparison>& surfaces) {
  const auto percent = [](int part, int whole) { return format_number(100.0 * part / whole, 1); };
  std::vector<std::vector<std::string>> rows;
  for (const SurfaceComparison& surface : surfaces) {
    const MeshDistance& accuracy = surface.accuracy;
    const MeshDistance& completeness = surface.completeness;
    rows.push_back({surface.run, surface.reference, percent(accuracy.num_within, accuracy.num_vertices),
                    percent(accuracy.num_near, accuracy.num_vertices), format_number(1000.0 * accuracy.median_m, 1),
                    format_number(1000.0 * accuracy.p95_m, 1), percent(completeness.num_near, completeness.num_vertices)});
  }
  return format_table({"surface", "against", "% within a voxel", "% within 5 cm", "median mm", "p95 mm", "% complete"}, rows);
}

}  // namespace

RunCounts count_frames(const ReplayRun& run) {
  RunCounts counts;
  int num_with_depth = 0;
  for (const ReplayFrame& frame : run.frames) {
    ++counts.num_frames;
    counts.num_tracking += frame.result.state == RecoveryState::kTracking ? 1 : 0;
    counts.num_settling += frame.result.state == RecoveryState::kSettling ? 1 : 0;
    counts.num_lost += frame.result.state == RecoveryState::kLost ? 1 : 0;
    counts.num_fused += frame.result.fused ? 1 : 0;
    counts.num_relocalised += frame.result.relocalised ? 1 : 0;
    counts.num_without_true_pose += frame.world_from_camera_true.has_value() ? 0 : 1;
    counts.num_without_depth += frame.has_depth || frame.step.covered ? 0 : 1;
    counts.num_blocks_refused += frame.result.num_blocks_refused;
    counts.out_of_range_fraction += static_cast<double>(frame.result.out_of_range_fraction);
    num_with_depth += frame.has_depth ? 1 : 0;
  }
  if (num_with_depth > 0) counts.out_of_range_fraction /= num_with_depth;
  return counts;
}

std::map<std::string, Spread> stage_times(const ReplayRun& run) {
  std::map<std::string, std::vector<double>> times;
  for (const ReplayFrame& frame : run.frames) {
    const FusionFrameResult& result = frame.result;
    if (result.track_ms > 0.0) times["track"].push_back(result.track_ms);
    if (result.relocaliser_asked) times["relocalise"].push_back(result.relocalise_ms);
    if (result.fused) times["fuse"].push_back(result.fuse_ms);
    if (result.trained) times["train"].push_back(result.train_ms);
    if (result.render_ms > 0.0) times["render"].push_back(result.render_ms);
    times["all"].push_back(result.total_ms);
    if (std::isfinite(frame.cpu_ms)) times["cpu"].push_back(frame.cpu_ms);
  }
  std::map<std::string, Spread> spreads;
  for (const auto& [stage, values] : times) spreads[stage] = spread_of(values);
  return spreads;
}

std::map<std::string, KidnapSummary> kidnap_summaries(const ReplayResult& result) {
  std::map<std::string, std::vector<KidnapOutcome>> outcomes;
  for (const KidnapRecord& record : result.kidnaps) {
    if (record.outcome.num_judged == 0) continue;  // interrupted before it came, or the undisturbed run was lost there
    outcomes[to_string(record.kidnap.kind)].push_back(record.outcome);
    outcomes["all"].push_back(record.outcome);
  }
  if (outcomes.size() == 2) outcomes.erase("all");
  std::map<std::string, KidnapSummary> summaries;
  for (const auto& [kind, of_kind] : outcomes) summaries[kind] = summarise_kidnaps(of_kind);
  return summaries;
}

/// What the recording lacks.
std::string lacks_text(const ReplayRun& run) {
  const RunCounts counts = count_frames(run);
  std::string text;
  if (counts.num_without_depth > 0) text += std::to_string(counts.num_without_depth) + " frames have no depth. ";
  if (counts.num_without_true_pose > 0 && counts.num_without_true_pose < counts.num_frames) {
    text += std::to_string(counts.num_without_true_pose) + " frames have no true pose, and are left out of ATE. ";
  }
  if (!text.empty()) text.back() = '\n';
  return text;
}

std::string text_report(const ReplayOptions& options, const ReplayResult& result) {
  std::string text = options.sequence + ", relocaliser: " + options.method + "\n\n" + run_table(result) + lacks_text(result.undisturbed) +
                     "\n" + time_table(result.main_run());
  if (!result.kidnaps.empty()) {
    text += "\n" + kidnap_table(result) + "\nRight: within 10 cm and 10 deg of the undisturbed run's pose of the same frame.\n";
  }
  if (!result.surfaces.empty()) text += "\n" + surface_table(result.surfaces);
  return text + "Peak memory: " + format_number(result.peak_mb, 0) + " MB\n";
}

}  // namespace foothold::replay

// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "common/json.h"
#include "common/log.h"
#include "foothold/base/settings.h"
#include "report.h"

namespace foothold::replay {
namespace {

using apps::Json;

/// Raised when a key changes its meaning or goes away; new keys do not raise it.
constexpr int kFormatVersion = 2;

Json ate_json(const AbsoluteTrajectoryError& error) {
  return {{"rmse_m", error.rmse_m}, {"mean_m", error.mean_m}, {"median_m", error.median_m}, {"max_m", error.max_m}};
}

Json run_json(const ReplayRun& run) {
  const RunCounts counts = count_frames(run);
  Json json = {{"frames", counts.num_frames},
               {"tracking", counts.num_tracking},
               {"settling", counts.num_settling},
               {"lost", counts.num_lost},
               {"fused", counts.num_fused},
               {"relocalised", counts.num_relocalised},
               {"without_true_pose", counts.num_without_true_pose},
               {"without_depth", counts.num_without_depth},
               {"blocks_refused", counts.num_blocks_refused},
               {"depth_out_of_range", counts.out_of_range_fraction}};
  if (const std::optional<RunError> error = run_error(run); error.has_value()) {
    json["ate_frames"] = error->num_frames;
    json["ate"] = ate_json(error->raw);
    json["ate_aligned"] = ate_json(error->aligned);
  }
  json["vertices"] = run.mesh.vertices.size();
  json["map_mb"] = static_cast<double>(run.map_bytes) * kMb;
  json["relocaliser_mb"] = static_cast<double>(run.relocaliser_bytes) * kMb;
  json["timing"] = {{"wall_s", run.wall_s}, {"frames_per_second", static_cast<double>(counts.num_frames) / run.wall_s}};
  for (const auto& [stage, ms] : stage_times(run)) {
    json["timing"][stage + "_ms"] = {{"median", ms.median}, {"p95", ms.p95}};
  }
  return json;
}

Json summary_json(const KidnapSummary& summary) {
  return {{"kidnaps", summary.num_kidnaps},
          {"recovered", summary.num_recovered},
          {"right_at_end", summary.num_right_at_end},
          {"with_wrong_poses", summary.num_kidnaps_with_wrong},
          {"resumed_wrongly", summary.num_kidnaps_with_wrong_believed},
          {"wrong_poses", summary.num_wrong},
          {"wrong_poses_believed", summary.num_wrong_believed},
          {"wrong_poses_fused", summary.num_wrong_fused},
          {"median_frames", summary.median_frames},
          {"p95_frames", summary.p95_frames},
          {"median_ms", summary.median_ms}};
}

Json kidnap_json(const KidnapRecord& record) {
  const KidnapOutcome& outcome = record.outcome;
  return {{"kind", to_string(record.kidnap.kind)},
          {"from", record.kidnap.from},
          {"to", record.kidnap.to},
          {"covered", record.kidnap.num_covered},
          {"judged", outcome.num_judged},
          {"mapped", record.mapped.has_value() ? Json(*record.mapped) : Json(nullptr)},
          {"recovered", outcome.recovered},
          {"right_at_end", outcome.right_at_end},
          {"frames", outcome.recovered ? Json(outcome.num_frames) : Json(nullptr)},
          {"ms", outcome.recovered ? Json(outcome.duration_ms) : Json(nullptr)},
          {"wrong_poses", outcome.num_wrong},
          {"wrong_poses_believed", outcome.num_wrong_believed},
          {"wrong_poses_fused", outcome.num_wrong_fused}};
}

Json mesh_json(const MeshDistance& distance) {
  return {{"vertices", distance.num_vertices},
          {"within_a_voxel", distance.num_within},
          {"near", distance.num_near},
          {"mean_m", distance.mean_m},
          {"rmse_m", distance.rmse_m},
          {"median_m", distance.median_m},
          {"p95_m", distance.p95_m}};
}

Json settings_json(const ReplaySettings& settings) {
  std::vector<std::pair<std::string, std::string>> texts;
  for (const SettingDescription& setting : describe_settings(settings)) texts.emplace_back(setting.path, setting.value);
  return Json::nested(texts);
}

Json head_json(const ReplayOptions& options, const ReplaySettings& settings, const ReplayResult& result) {
  const KidnapOptions& kidnaps = options.kidnaps;
  return {{"format", "foothold-replay"},
          {"format_version", kFormatVersion},
          {"sequence", options.sequence},
          {"method", options.method},
          {"device", options.device.device},
          {"threads", options.device.num_threads},
          {"stride", options.stride},
          {"kidnap_options",
           {{"removed", kidnaps.num_removed},
            {"removed_length", kidnaps.removed_length},
            {"teleports", kidnaps.num_teleports},
            {"leaps", kidnaps.num_leaps},
            {"blackouts", kidnaps.num_blackouts},
            {"blackout_length", kidnaps.blackout_length},
            {"judged", kidnaps.num_judged},
            {"independent", options.independent},
            {"seed", kidnaps.seed}}},
          {"settings", settings_json(settings)},
          {"warnings", apps::warnings()},
          {"broken_off", result.broken_off.empty() ? Json(nullptr) : Json(result.broken_off)},
          {"complete", result.complete}};
}

}  // namespace

std::string json_report(const ReplayOptions& options, const ReplaySettings& settings, const ReplayResult& result) {
  Json json = head_json(options, settings, result);
  json["undisturbed"] = run_json(result.undisturbed);
  if (result.kidnapped.has_value()) {
    json["kidnapped"] = run_json(*result.kidnapped);
    json["kidnapped"]["wrong_poses"] = result.whole_kidnapped.num_wrong;
    json["kidnapped"]["wrong_poses_believed"] = result.whole_kidnapped.num_wrong_believed;
    json["kidnapped"]["wrong_poses_fused"] = result.whole_kidnapped.num_wrong_fused;
  }
  for (const SurfaceComparison& surface : result.surfaces) {
    json["surfaces"].push_back({{"run", surface.run},
                                {"reference", surface.reference},
                                {"accuracy", mesh_json(surface.accuracy)},
                                {"completeness", mesh_json(surface.completeness)}});
  }
  json["summary"] = Json::object();
  for (const auto& [kind, summary] : kidnap_summaries(result)) json["summary"][kind] = summary_json(summary);
  json["kidnaps"] = Json::array();
  for (const KidnapRecord& record : result.kidnaps) {
    if (!record.frames.empty()) json["kidnaps"].push_back(kidnap_json(record));
  }
  json["peak_mb"] = result.peak_mb;
  return json.dump() + "\n";
}

}  // namespace foothold::replay

// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include <algorithm>
#include <cstdio>
#include <memory>

#include "commands.h"
#include "common/progress_bar.h"
#include "common/recording_options.h"
#include "foothold/base/error.h"
#include "foothold/evaluation/text_table.h"
#include "foothold/io/sequence.h"
#include "foothold/io/sequence_player.h"
#include "kidnap_runs.h"
#include "outputs.h"
#include "run_methods.h"
#include "scene_tables.h"

namespace foothold::benchmark {
namespace {

struct KidnapCommandOptions {
  CommonOptions common;
  std::string sequence;
  KidnapOptions kidnaps;
};

/// What the kidnaps of a run, or some of them, come to.
struct Totals {
  KidnapSummary summary;
  int num_seen = 0;
  int num_seen_recovered = 0;
};

Totals total_of(const KidnapRun& run, const std::function<bool(const KidnapRecord&)>& counts) {
  Totals totals;
  std::vector<KidnapOutcome> outcomes;
  for (const KidnapRecord& record : run.kidnaps) {
    if (!counts(record)) continue;
    outcomes.push_back(record.outcome);
    totals.num_seen += record.was_seen ? 1 : 0;
    totals.num_seen_recovered += record.was_seen && record.outcome.recovered ? 1 : 0;
  }
  totals.summary = summarise_kidnaps(outcomes);
  return totals;
}

bool any(const KidnapRecord&) { return true; }

Json totals_json(const Totals& totals) {
  const KidnapSummary& s = totals.summary;
  return {{"num_kidnaps", s.num_kidnaps},           {"num_recovered", s.num_recovered},
          {"num_seen_before", totals.num_seen},     {"num_seen_before_recovered", totals.num_seen_recovered},
          {"num_right_at_end", s.num_right_at_end}, {"num_false_resumes", s.num_kidnaps_with_wrong_believed},
          {"num_wrong_fusions", s.num_wrong_fused}, {"median_frames_to_recovery", s.median_frames},
          {"p95_frames_to_recovery", s.p95_frames}, {"timing", {{"median_ms_to_recovery", s.median_ms}}}};
}

Json kidnap_json(const KidnapRecord& record) {
  const KidnapOutcome& o = record.outcome;
  return {{"kind", to_string(record.kidnap.kind)},
          {"from", record.kidnap.from},
          {"to", record.kidnap.to},
          {"seen_before", record.was_seen},
          {"recovered", o.recovered},
          {"frames_to_recovery", o.recovered ? Json(o.num_frames) : Json(nullptr)},
          {"right_at_end", o.right_at_end},
          {"num_wrong_believed", o.num_wrong_believed},
          {"num_wrong_fused", o.num_wrong_fused}};
}

Json run_json(const KidnapRun& run) {
  Json json = totals_json(total_of(run, any));
  json["num_frames"] = run.num_frames;
  json["num_tracked_frames"] = run.num_tracked_frames;
  for (const KidnapKind kind : {KidnapKind::kRemoved, KidnapKind::kTeleport}) {
    const Totals totals = total_of(run, [kind](const KidnapRecord& record) { return record.kidnap.kind == kind; });
    if (totals.summary.num_kidnaps > 0) json["kinds"][to_string(kind)] = totals_json(totals);
  }
  json["kidnaps"] = Json::array();
  for (const KidnapRecord& record : run.kidnaps) json["kidnaps"].push_back(kidnap_json(record));
  return json;
}

std::string kidnap_table(const std::vector<KidnapRun>& runs) {
  const auto of = [](int part, int whole) { return std::to_string(part) + " of " + std::to_string(whole); };
  std::vector<std::vector<std::string>> rows;
  for (const KidnapRun& run : runs) {
    const Totals totals = total_of(run, any);
    const KidnapSummary& s = totals.summary;
    rows.push_back({run.method, of(s.num_recovered, s.num_kidnaps), of(totals.num_seen_recovered, totals.num_seen),
                    format_number(s.median_frames, 1), format_number(s.median_ms, 0), std::to_string(s.num_kidnaps_with_wrong_believed),
                    std::to_string(s.num_wrong_fused)});
  }
  return format_table(
      {"method", "resumed rightly", "where seen before", "frames, median", "ms, median", "resumed wrongly", "frames fused wrongly"}, rows);
}

std::string kidnap_csv(const std::vector<KidnapRun>& runs) {
  std::string csv = "method,kind,from,to,seen_before,recovered,frames_to_recovery,ms_to_recovery,num_wrong_believed,num_wrong_fused\n";
  for (const KidnapRun& run : runs) {
    for (const KidnapRecord& record : run.kidnaps) {
      const KidnapOutcome& o = record.outcome;
      csv += csv_cell(run.method) + "," + to_string(record.kidnap.kind) + "," + std::to_string(record.kidnap.from) + "," +
             std::to_string(record.kidnap.to) + "," + (record.was_seen ? "1," : "0,") + (o.recovered ? "1," : "0,") +
             (o.recovered ? std::to_string(o.num_frames) + "," + csv_number(o.duration_ms) : ",") + "," +
             std::to_string(o.num_wrong_believed) + "," + std::to_string(o.num_wrong_fused) + "\n";
    }
  }
  return csv;
}

std::vector<Method> kidnappable_methods(const CommonOptions& options) {
  const std::vector<Method> methods = find_methods(options.methods);
  for (const Method& method : methods) {
    if (!can_be_kidnapped(method))
      throw InvalidSettings("--method: got '" + method.name +
                            "'; expected forest, paper or ferns, whose proposals the reconstruction refines itself");
  }
  return methods;
}

int run_kidnap(const KidnapCommandOptions& options) {
  check_outputs(options.common);
  options.kidnaps.validate();
  const std::vector<Method> methods = kidnappable_methods(options.common);
  const MethodInputs inputs = method_inputs(options.common, methods);
  const Context context = apps::make_context(options.common.device);
  KidnapInput input;
  input.sequence = open_sequence(options.sequence, context, options.common.recording);
  input.indices = frame_indices(*input.sequence, options.common.stride);
  input.options = options.kidnaps;
  input.options.seed = options.common.seed;
  input.kidnaps = plan_independent_kidnaps(static_cast<int>(input.indices.size()), input.options);
  std::vector<KidnapRun> runs;
  try {
    for (const Method& method : methods) {
      apps::ProgressBar bar(method.name, count_frames(input));
      runs.push_back(run_kidnaps(context, method, inputs, input, [&] {
        if (apps::interrupted()) throw Interrupted{};
        bar.advance();
      }));
    }
  } catch (const Interrupted&) {
    return apps::kInterrupted;
  }
  std::printf("%zu kidnaps out of %zu frames, each judged within %d frames at 10 cm and 10 deg\n\n%s", input.kidnaps.size(),
              input.indices.size(), input.options.num_judged, kidnap_table(runs).c_str());
  std::vector<std::pair<std::string, std::string>> described = describe_options(options.common);
  described.emplace_back("removed", std::to_string(options.kidnaps.num_removed));
  described.emplace_back("removed_length", std::to_string(options.kidnaps.removed_length));
  described.emplace_back("teleports", std::to_string(options.kidnaps.num_teleports));
  described.emplace_back("judged", std::to_string(options.kidnaps.num_judged));
  Json json = document_head("kidnap", described);
  json["sequence"] = options.sequence;
  json["methods"] = Json::object();
  for (const KidnapRun& run : runs) json["methods"][run.method] = run_json(run);
  std::printf("%s", write_documents(options.common, json, kidnap_csv(runs)).c_str());
  return apps::kSuccess;
}

}  // namespace

Command add_kidnap_command(apps::CommandLine& app) {
  const auto options = std::make_shared<KidnapCommandOptions>();
  options->common.methods = {"forest", "ferns"};
  options->kidnaps.num_removed = 10;
  options->kidnaps.num_teleports = 10;
  apps::CommandLine command =
      app.add_subcommand("kidnap", "The closed loop: the camera is suddenly elsewhere, and tracker, relocaliser and map find it again");
  command.add_option("--sequence", options->sequence, apps::kRecordingHelp).required();
  command.add_option("--removed", options->kidnaps.num_removed, "Kidnaps over a stretch of frames that is left out").show_default();
  command.add_option("--removed-length", options->kidnaps.removed_length, "Frames of each such stretch").show_default();
  command.add_option("--teleports", options->kidnaps.num_teleports, "Kidnaps back to an earlier part of the recording").show_default();
  command.add_option("--judged", options->kidnaps.num_judged, "Frames within which the camera must be found").show_default();
  add_forest_option(command, options->common);
  add_experiment_options(command, options->common);
  return {command, [options] { return run_kidnap(*options); }};
}

}  // namespace foothold::benchmark

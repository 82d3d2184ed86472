// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include <map>
#include <set>
#include <utility>

#include "foothold/evaluation/text_table.h"
#include "outputs.h"

namespace foothold::benchmark {
namespace {

constexpr const char* kDurationKey = "\nCPU: of the calling thread, which is the whole work only with --threads 1.\n";

/// What the columns of the summary mean.
constexpr const char* kSummaryKey =
    "\nN/N %: found within N cm and N deg. first: first frame found within 5/5. mm, deg: median errors of the answers. accepted %: found "
    "within\n"
    "5/5 and confident. false: confident, but beyond 10/10. ms: median/95th percentile. state: the learnt scene. peak: the whole "
    "process.\n";

/// "median/p95".
std::string spread(const Spread& ms) { return format_number(ms.median, 2) + "/" + format_number(ms.p95, 2); }

}  // namespace

std::string summary_table(const BenchmarkResult& result) {
  std::vector<std::string> header = {"method"};
  for (const PoseThreshold& threshold : recall_ladder()) {
    header.push_back(format_number(threshold.translation_m * 100.0, 0) + "/" + format_number(threshold.rotation_deg, 0) + " %");
  }
  for (const char* name : {"first", "mm", "deg", "accepted %", "false", "train ms", "relocalise ms", "state MB", "peak MB"}) {
    header.emplace_back(name);
  }
  std::vector<std::vector<std::string>> rows;
  for (const MethodResult& method : result.methods) {
    const MethodReport& report = method.report;
    std::vector<std::string> row = {method.name};
    for (const Recall& recall : report.recall) row.push_back(percent(recall.fraction));
    row.push_back(report.first_success_frame.has_value() ? std::to_string(*report.first_success_frame) : "-");
    row.push_back(format_number(report.median_translation_m * 1e3, 1));
    row.push_back(format_number(report.median_rotation_deg, 2));
    row.push_back(percent(report.accepted_recall));
    row.push_back(std::to_string(report.num_false_accepts));
    row.push_back(spread(report.train.wall_ms));
    row.push_back(spread(report.relocalise.wall_ms));
    row.push_back(format_number(report.state_mb, 1));
    row.push_back(format_number(method.peak_mb, 0));
    rows.push_back(std::move(row));
  }
  return format_table(header, rows) + kSummaryKey;
}

std::string duration_table(const BenchmarkResult& result) {
  const std::pair<const char*, Spread (*)(const MethodReport&)> calls[] = {
      {"train", [](const MethodReport& report) { return report.train.wall_ms; }},
      {"train, CPU", [](const MethodReport& report) { return report.train.cpu_ms; }},
      {"relocalise", [](const MethodReport& report) { return report.relocalise.wall_ms; }},
      {"relocalise, CPU", [](const MethodReport& report) { return report.relocalise.cpu_ms; }},
      {"update", [](const MethodReport& report) { return report.update.wall_ms; }}};
  std::set<std::string> stages;
  std::vector<std::string> header = {"ms, median/p95"};
  for (const MethodResult& method : result.methods) {
    header.push_back(method.name);
    for (const auto& [stage, ms] : stages_of(method.report)) stages.insert(stage);
  }
  std::vector<std::vector<std::string>> rows;
  for (const auto& [name, durations_of] : calls) {
    rows.push_back({name});
    for (const MethodResult& method : result.methods) rows.back().push_back(spread(durations_of(method.report)));
  }
  if (result.methods.front().report.update.num_calls == 0) rows.pop_back();
  for (const std::string& stage : stages) {
    rows.push_back({stage});
    for (const MethodResult& method : result.methods) {
      const std::map<std::string, Spread> all = stages_of(method.report);
      rows.back().push_back(all.count(stage) == 0 ? "" : spread(all.at(stage)));
    }
  }
  return format_table(header, rows) + kDurationKey;
}

std::string novelty_table(const BenchmarkResult& result) {
  if (result.methods.empty() || result.methods.front().novelty.empty()) return {};
  std::vector<std::string> header = {"nearest training view", "frames"};
  for (const MethodResult& method : result.methods) header.push_back(method.name + " % [95 % interval]");
  std::vector<std::vector<std::string>> rows;
  for (std::size_t bin = 0; bin < result.methods.front().novelty.size(); ++bin) {
    const NoveltyBin& first = result.methods.front().novelty[bin];
    std::vector<std::string> row = {first.is_rest ? "beyond"
                                                  : "within " + format_number(first.limit.translation_m * 100.0, 0) + " cm/" +
                                                        format_number(first.limit.rotation_deg, 0) + " deg",
                                    std::to_string(first.num_frames)};
    for (const MethodResult& method : result.methods) {
      const NoveltyBin& each = method.novelty[bin];
      row.push_back(each.num_frames == 0 ? "-"
                                         : percent(static_cast<double>(each.num_found) / each.num_frames) + " [" +
                                               percent(each.recall_95.low) + ", " + percent(each.recall_95.high) + "]");
    }
    rows.push_back(std::move(row));
  }
  return format_table(header, rows);
}

std::string left_out_text(const BenchmarkResult& result) {
  if (result.methods.empty()) return {};
  const MethodReport& report = result.methods.front().report;  // the frames are the same for all
  std::string text;
  const auto frames = [](int count) { return std::to_string(count) + (count == 1 ? " frame" : " frames"); };
  if (report.num_without_pose > 0) text += frames(report.num_without_pose) + " without a true pose left out. ";
  if (report.num_without_depth > 0) text += frames(report.num_without_depth) + " without depth not found, and not learnt. ";
  if (!text.empty()) text.back() = '\n';
  return text;
}

std::string all_tables(const BenchmarkResult& result) {
  std::string tables = summary_table(result) + left_out_text(result) + "\n";
  const std::string novelty = novelty_table(result);
  if (!novelty.empty()) tables += novelty + "\n";
  return tables + duration_table(result);
}

}  // namespace foothold::benchmark

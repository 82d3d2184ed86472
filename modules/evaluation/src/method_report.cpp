// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "foothold/evaluation/method_report.h"

#include <algorithm>
#include <cmath>

#include "foothold/base/angle.h"
#include "foothold/base/trace.h"

namespace foothold {
namespace {

/// Tests in a window of MethodReport::recall_per_100.
constexpr std::size_t kWindowTests = 100;

double fraction_of(int part, std::size_t whole) { return whole == 0 ? 0.0 : static_cast<double>(part) / static_cast<double>(whole); }

int count_within(const std::vector<TestRecord>& tests, const PoseThreshold& threshold) {
  return static_cast<int>(std::count_if(tests.begin(), tests.end(), [&](const TestRecord& test) { return test.within(threshold); }));
}

std::vector<RecallWindow> recall_windows(const std::vector<TestRecord>& tests) {
  std::vector<RecallWindow> windows;
  for (std::size_t begin = 0; begin < tests.size(); begin += kWindowTests) {
    const std::size_t end = std::min(begin + kWindowTests, tests.size());
    const std::vector<TestRecord> window(tests.begin() + static_cast<std::ptrdiff_t>(begin),
                                         tests.begin() + static_cast<std::ptrdiff_t>(end));
    windows.push_back(
        {window.front().frame_index, static_cast<int>(window.size()), fraction_of(count_within(window, kFoundThreshold), window.size())});
  }
  return windows;
}

CallReport call_report(const CallTimes& times) {
  CallReport report;
  report.num_calls = static_cast<int>(times.wall_ms.size());
  report.wall_ms = spread_of(times.wall_ms);
  report.cpu_ms = spread_of(times.cpu_ms);
  for (const auto& [stage, durations_ms] : times.stages_ms) report.stages_ms[stage] = spread_of(durations_ms);
  return report;
}

void report_accuracy(const std::vector<TestRecord>& tests, MethodReport& report) {
  std::vector<double> translations_m;
  std::vector<double> rotations_deg;
  for (const TestRecord& test : tests) {
    if (!report.first_success_frame.has_value() && test.within(kFoundThreshold)) report.first_success_frame = test.frame_index;
    if (!test.best.has_value()) continue;
    translations_m.push_back(test.error.translation_m);
    rotations_deg.push_back(test.error.rotation_rad * kDegPerRad);
  }
  for (const PoseThreshold& threshold : recall_ladder()) {
    const int num_found = count_within(tests, threshold);
    report.recall.push_back({threshold, num_found, fraction_of(num_found, tests.size())});
  }
  report.recall_95 = wilson_interval(count_within(tests, kFoundThreshold), static_cast<int>(tests.size()));
  report.recall_per_100 = recall_windows(tests);
  report.num_answered = static_cast<int>(translations_m.size());
  report.median_translation_m = quantile(translations_m, 0.5);
  report.median_rotation_deg = quantile(rotations_deg, 0.5);
}

void report_confidence(const std::vector<TestRecord>& tests, MethodReport& report) {
  std::vector<double> confidences;
  std::vector<bool> right;
  int num_accepted_found = 0;
  for (const TestRecord& test : tests) {
    if (!test.best.has_value()) continue;
    confidences.push_back(test.best->confidence);
    right.push_back(test.within(kWrongThreshold));
    if (test.best->confidence < report.acceptance_threshold) continue;
    ++report.num_accepted;
    num_accepted_found += test.within(kFoundThreshold) ? 1 : 0;
    report.num_false_accepts += test.within(kWrongThreshold) ? 0 : 1;
  }
  report.accepted_recall = fraction_of(num_accepted_found, tests.size());
  report.false_confidence_rate = fraction_of(report.num_false_accepts, static_cast<std::size_t>(report.num_accepted));
  report.confidence_roc_area = roc_area(confidences, right);
}

}  // namespace

MethodReport make_report(const RunLog& log) {
  MethodReport report;
  report.num_tested = static_cast<int>(log.tests.size());
  report.num_trained = static_cast<int>(log.trained_world_from_camera.size());
  report.num_without_pose = log.num_without_pose;
  report.num_without_depth = log.num_without_depth;
  report.acceptance_threshold = log.acceptance_threshold;
  report_accuracy(log.tests, report);
  report_confidence(log.tests, report);
  report.train = call_report(log.train);
  report.relocalise = call_report(log.relocalise);
  report.update = call_report(log.update);
  report.state_mb = static_cast<double>(log.state_bytes) * 1e-6;
  return report;
}

}  // namespace foothold

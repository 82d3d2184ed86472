// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "foothold/evaluation/confidence_report.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "foothold/base/contract.h"

namespace foothold {
namespace {

constexpr int kCalibrationBins = 10;
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

double ratio(int part, int whole) { return whole == 0 ? 0.0 : static_cast<double>(part) / whole; }

/// Counts accepted answers, the most confident first.
class Acceptance {
 public:
  Acceptance(Span<const ConfidenceSample> samples, int num_findable)
      : num_samples_(static_cast<int>(samples.size())), num_findable_(num_findable) {}

  void accept(const ConfidenceSample& sample) {
    ++point_.num_accepted;
    point_.num_false_accepts += sample.right ? 0 : 1;
    num_found_ += sample.found && sample.findable ? 1 : 0;
  }
  AcceptancePoint at(double threshold) const {
    AcceptancePoint point = point_;
    point.threshold = threshold;
    point.recall = ratio(num_found_, num_findable_);
    point.false_accept_rate = ratio(point.num_false_accepts, num_samples_);
    return point;
  }

 private:
  AcceptancePoint point_;
  int num_found_ = 0;
  int num_samples_;
  int num_findable_;
};

std::vector<ConfidenceSample> most_confident_first(Span<const ConfidenceSample> samples) {
  std::vector<ConfidenceSample> answers;
  for (const ConfidenceSample& sample : samples) {
    if (sample.confidence.has_value()) answers.push_back(sample);
  }
  std::stable_sort(answers.begin(), answers.end(),
                   [](const ConfidenceSample& a, const ConfidenceSample& b) { return *a.confidence > *b.confidence; });
  return answers;
}

void trace_curve(Span<const ConfidenceSample> samples, const std::vector<ConfidenceSample>& answers, double acceptance_threshold,
                 ConfidenceReport& report) {
  Acceptance acceptance(samples, report.num_findable);
  report.curve.push_back(acceptance.at(std::numeric_limits<double>::infinity()));
  report.without_false = report.curve.front();
  report.at_threshold = acceptance.at(acceptance_threshold);
  for (std::size_t i = 0; i < answers.size();) {
    const double threshold = *answers[i].confidence;
    for (; i < answers.size() && *answers[i].confidence == threshold; ++i) acceptance.accept(answers[i]);
    report.curve.push_back(acceptance.at(threshold));
    if (threshold >= acceptance_threshold) report.at_threshold = acceptance.at(acceptance_threshold);
    if (report.curve.back().num_false_accepts == 0) report.without_false = report.curve.back();
  }
}

void fill_calibration(const std::vector<ConfidenceSample>& answers, ConfidenceReport& report) {
  report.calibration.resize(kCalibrationBins);
  std::vector<double> sums(kCalibrationBins, 0.0);
  for (const ConfidenceSample& answer : answers) {
    const int index = std::min(kCalibrationBins - 1, static_cast<int>(*answer.confidence * kCalibrationBins));
    CalibrationBin& bin = report.calibration[static_cast<std::size_t>(index)];
    ++bin.num_answers;
    bin.num_right += answer.right ? 1 : 0;
    sums[static_cast<std::size_t>(index)] += *answer.confidence;
    report.brier_score += std::pow(*answer.confidence - (answer.right ? 1.0 : 0.0), 2.0) / static_cast<double>(answers.size());
  }
  for (int i = 0; i < kCalibrationBins; ++i) {
    CalibrationBin& bin = report.calibration[static_cast<std::size_t>(i)];
    bin.low = static_cast<double>(i) / kCalibrationBins;
    bin.high = static_cast<double>(i + 1) / kCalibrationBins;
    bin.mean_confidence = bin.num_answers == 0 ? kNan : sums[static_cast<std::size_t>(i)] / bin.num_answers;
    bin.right_95 = wilson_interval(bin.num_right, bin.num_answers);
    if (bin.num_answers == 0) continue;
    report.calibration_error +=
        std::abs(bin.mean_confidence - ratio(bin.num_right, bin.num_answers)) * bin.num_answers / static_cast<double>(answers.size());
  }
}

}  // namespace

ConfidenceSample confidence_sample(const TestRecord& test, bool findable) {
  ConfidenceSample sample;
  if (test.best.has_value()) sample.confidence = static_cast<double>(test.best->confidence);
  sample.findable = findable;
  sample.found = findable && test.within(kFoundThreshold);
  sample.right = findable && test.within(kWrongThreshold);
  return sample;
}

ConfidenceReport make_confidence_report(Span<const ConfidenceSample> samples, double acceptance_threshold) {
  ConfidenceReport report;
  report.num_samples = static_cast<int>(samples.size());
  for (const ConfidenceSample& sample : samples) {
    FOOTHOLD_EXPECTS(!sample.confidence.has_value() || (*sample.confidence >= 0.0 && *sample.confidence <= 1.0));
    report.num_findable += sample.findable ? 1 : 0;
  }
  const std::vector<ConfidenceSample> answers = most_confident_first(samples);
  report.num_answers = static_cast<int>(answers.size());
  trace_curve(samples, answers, acceptance_threshold, report);
  fill_calibration(answers, report);
  if (answers.empty()) {
    report.calibration_error = kNan;
    report.brier_score = kNan;
  }
  std::vector<double> scores;
  std::vector<bool> right;
  for (const ConfidenceSample& answer : answers) {
    scores.push_back(*answer.confidence);
    right.push_back(answer.right);
  }
  report.roc_area = roc_area(scores, right);
  return report;
}

}  // namespace foothold

// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include <algorithm>

#include "chart.h"
#include "foothold/evaluation/text_table.h"
#include "foothold/io/image_file.h"
#include "trust_questions.h"
#include "trust_report.h"

namespace foothold::benchmark {
namespace {

using apps::Canvas;
using apps::TextAlign;

constexpr int kWidth = 1200;
constexpr double kMargin = 24.0;
constexpr double kChartHeight = 420.0;
constexpr double kBarHeight = 15.0;
constexpr double kBarPitch = 21.0;
constexpr double kNameWidth = 190.0;
constexpr double kCountWidth = 130.0;  ///< of "12345 / 123456"
constexpr double kTextHeight = 10.0;
constexpr Rgb8 kInk = {40, 40, 40};

/// A part of a bar.
struct Part {
  const char* name;
  Rgb8 colour;
  int (*count)(const BeliefCounts&);
};
constexpr Part kParts[] = {
    {"right, believed", {0, 158, 115}, [](const BeliefCounts& c) { return c.num_right_believed; }},
    {"right, not believed", {166, 219, 196}, [](const BeliefCounts& c) { return c.num_right_unbelieved; }},
    {"neither", {222, 222, 222}, [](const BeliefCounts& c) { return c.num_wrong_unbelieved + c.num_unanswered(); }},
    {"wrong, believed", {213, 94, 0}, [](const BeliefCounts& c) { return c.num_wrong_believed; }},
};

Chart risk_chart(const std::vector<MethodTrust>& methods) {
  Chart chart{"Risk: share of the believed that is wrong", "coverage: share of all questions that is believed", {}, 0.0, true, false};
  for (const MethodTrust& method : methods) {
    Curve curve{method.method, {}, false};
    for (const AcceptancePoint& point : method.confidence.curve) {
      if (point.num_accepted == 0) continue;
      curve.points.emplace_back(static_cast<double>(point.num_accepted) / method.confidence.num_samples,
                                static_cast<double>(point.num_false_accepts) / point.num_accepted);
    }
    chart.curves.push_back(std::move(curve));
  }
  return chart;
}

Chart reliability_chart(const std::vector<MethodTrust>& methods) {
  Chart chart{"Reliability: share of the answers that is right", "confidence", {}, 1.0, true, false};
  for (const MethodTrust& method : methods) {
    Curve curve{method.method + ", error " + format_number(method.confidence.calibration_error, 3), {}, true};
    for (const CalibrationBin& bin : method.confidence.calibration) {
      if (bin.num_answers > 0) curve.points.emplace_back(bin.mean_confidence, static_cast<double>(bin.num_right) / bin.num_answers);
    }
    chart.curves.push_back(std::move(curve));
  }
  chart.curves.push_back({"calibrated", {{0.0, 0.0}, {1.0, 1.0}}, false});
  return chart;
}

void draw_bar(Canvas& canvas, double top, const std::string& name, const BeliefCounts& counts) {
  const double middle = top + 0.5 * kBarHeight;
  canvas.text({kMargin + kNameWidth - 10.0, middle}, name, kTextHeight, kInk, TextAlign::kRight);
  double left = kMargin + kNameWidth;
  const double width = kWidth - kMargin - kCountWidth - left;
  for (const Part& part : kParts) {
    const double right = left + width * part.count(counts) / std::max(1, counts.num_questions);
    canvas.fill(cv::Rect(cv::Point(static_cast<int>(left), static_cast<int>(top)),
                         cv::Point(static_cast<int>(right), static_cast<int>(top + kBarHeight))),
                part.colour);
    left = right;
  }
  const std::string count = std::to_string(counts.num_wrong_believed) + " / " + std::to_string(counts.num_questions);
  canvas.text({kWidth - kMargin, middle}, count, kTextHeight, kInk, TextAlign::kRight);
}

/// The bars of one method. @return The lower end.
double draw_bars(Canvas& canvas, double top, const MethodTrust& method) {
  canvas.text({kMargin, top}, method.method + ": how questions ended; wrong and believed / all", 13.0, kInk);
  double x = kMargin + kNameWidth;
  for (const Part& part : kParts) {
    canvas.fill(cv::Rect(static_cast<int>(x), static_cast<int>(top + 14.0), 14, 14), part.colour);
    canvas.text({x + 20.0, top + 21.0}, part.name, kTextHeight, kInk);
    x += 20.0 + Canvas::text_width(part.name, kTextHeight) + 24.0;
  }
  double y = top + 38.0;
  for (const std::string& kind : question_kinds()) {
    const auto found = method.kinds.find(kind);
    if (found == method.kinds.end()) continue;
    draw_bar(canvas, y, kind, found->second);
    y += kBarPitch;
  }
  return y;
}

}  // namespace

void write_trust_plot(const std::string& path, const std::vector<MethodTrust>& methods) {
  double height = kChartHeight + 2.0 * kMargin;
  for (const MethodTrust& method : methods) height += 60.0 + kBarPitch * static_cast<double>(method.kinds.size());
  Canvas canvas(kWidth, static_cast<int>(height));
  const double half = 0.5 * kWidth;
  draw_chart(canvas, {kMargin, kMargin, half - kMargin, kChartHeight}, risk_chart(methods));
  draw_chart(canvas, {half, kMargin, kWidth - kMargin, kChartHeight}, reliability_chart(methods));
  double top = kChartHeight + kMargin;
  for (const MethodTrust& method : methods) top = draw_bars(canvas, top, method) + 22.0;
  write_png(path, canvas.image());
}

}  // namespace foothold::benchmark

// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "roc_plot.h"

#include <algorithm>
#include <cmath>

#include "common/canvas.h"
#include "foothold/base/number_text.h"

namespace foothold::apps {

namespace {
constexpr int kPanelWidth = 460;
constexpr int kHeight = 400;
constexpr int kMargin = 60;
constexpr double kLeastRate = 1e-4;
constexpr Rgb8 kInk{40, 40, 40};
constexpr Rgb8 kGrid{220, 220, 220};
constexpr Rgb8 kCurve{30, 100, 190};
constexpr Rgb8 kMark{200, 60, 40};

class Panel {
 public:
  Panel(Canvas& canvas, int index) : canvas_(canvas), left_(index * kPanelWidth + kMargin) {}

  void draw(const NamedReport& named) {
    const ClassifierReport& report = named.report;
    canvas_.text({left_ + 0.5 * width(), 22.0}, named.title + ": AUC " + fixed_text(report.auc, 4), 11.0, kInk, TextAlign::kCentre);
    for (int decade = -4; decade <= 0; ++decade) {
      const double x = place({std::pow(10.0, decade), 0.0}).x;
      canvas_.line({x, top()}, {x, bottom()}, kGrid);
      canvas_.text({x, bottom() + 16.0}, general_text(std::pow(10.0, decade), 6), 9.0, kInk, TextAlign::kCentre);
    }
    for (int fifth = 0; fifth <= 5; ++fifth) {
      const double y = place({kLeastRate, 0.2 * fifth}).y;
      canvas_.line({left_, y}, {left_ + width(), y}, kGrid);
      canvas_.text({left_ - 8.0, y}, fixed_text(0.2 * fifth, 1), 9.0, kInk, TextAlign::kRight);
    }
    std::vector<cv::Point2d> curve;
    for (const RocPoint& point : report.roc) curve.push_back(place({point.false_positive_rate, point.true_positive_rate}));
    canvas_.polyline(curve, kCurve, 2.0);
    canvas_.disc(place({report.false_positive_rate_good, report.true_positive_rate_good}), 4.0, kMark);
    canvas_.text({left_ + 0.5 * width(), bottom() + 36.0}, "wrong poses called good (red: the shipped threshold)", 9.0, kInk,
                 TextAlign::kCentre);
    canvas_.text({left_, top() - 14.0}, "right poses called good", 9.0, kInk);
  }

 private:
  static double top() { return kMargin; }
  static double bottom() { return kHeight - kMargin; }
  static double width() { return kPanelWidth - kMargin - 20.0; }
  cv::Point2d place(const cv::Point2d& rates) const {
    const double x = 1.0 - std::log10(std::max(kLeastRate, rates.x)) / std::log10(kLeastRate);
    return {left_ + x * width(), bottom() - rates.y * (bottom() - top())};
  }

  Canvas& canvas_;
  double left_;
};
}  // namespace

Image<Rgb8> draw_roc(const std::vector<NamedReport>& reports) {
  Canvas canvas(kPanelWidth * static_cast<int>(reports.size()), kHeight);
  for (std::size_t i = 0; i < reports.size(); ++i) Panel(canvas, static_cast<int>(i)).draw(reports[i]);
  return canvas.image();
}

}  // namespace foothold::apps

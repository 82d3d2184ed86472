// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "chart.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "foothold/evaluation/text_table.h"

namespace foothold::benchmark {
namespace {

using apps::Canvas;
using apps::TextAlign;

constexpr double kLeftMargin = 62.0;
constexpr double kTopMargin = 56.0;  ///< of title and names
constexpr double kBottomMargin = 52.0;
/// Ticks closer than this lose their label [px].
constexpr double kTickSpacing = 34.0;

/// Maps the values of a chart into an area.
class Scale {
 public:
  Scale(const Chart& chart, const Box& area) : is_log_(chart.is_log_x), area_(area) {
    double most_y = 0.0;
    for (const Curve& curve : chart.curves) {
      for (const auto& [x, y] : curve.points) {
        if (!std::isfinite(x) || !std::isfinite(y)) continue;
        low_x_ = std::min(low_x_, along(x));
        high_x_ = std::max(high_x_, along(x));
        most_y = std::max(most_y, y);
      }
    }
    if (!(high_x_ > low_x_)) {  // one point, or none
      low_x_ = std::isfinite(low_x_) ? low_x_ - 0.5 : 0.0;
      high_x_ = low_x_ + 1.0;
    }
    most_y_ = chart.most_y > 0.0 ? chart.most_y : std::max(1e-9, 1.05 * most_y);
  }
  double x(double value) const { return area_.left + (area_.right - area_.left) * (along(value) - low_x_) / (high_x_ - low_x_); }
  double y(double value) const { return area_.bottom - (area_.bottom - area_.top) * value / most_y_; }
  double most_y() const { return most_y_; }
  /// The ends of a linear x axis.
  double low_x() const { return low_x_; }
  double high_x() const { return high_x_; }

 private:
  double along(double value) const { return is_log_ ? std::log1p(value) : value; }

  bool is_log_;
  Box area_;
  double low_x_ = INFINITY;
  double high_x_ = -INFINITY;
  double most_y_ = 1.0;
};

std::string short_number(double value) {
  const double magnitude = std::fabs(value);
  return format_number(value, magnitude >= 10.0 || value == std::floor(value) ? 0 : magnitude >= 1.0 ? 1 : 2);
}

std::vector<double> x_ticks(const Chart& chart, const Scale& scale) {
  if (chart.is_log_x) {
    std::set<double> values;
    for (const Curve& curve : chart.curves) {
      for (const auto& point : curve.points) values.insert(point.first);
    }
    return {values.begin(), values.end()};
  }
  std::vector<double> values;
  const double step = round_step(scale.high_x() - scale.low_x(), 8);
  for (double value = std::ceil(scale.low_x() / step) * step; value <= scale.high_x() + 1e-9; value += step) values.push_back(value);
  return values;
}

void draw_axes(Canvas& canvas, const Box& area, const Chart& chart, const Scale& scale) {
  const double step = round_step(scale.most_y(), 5);
  for (double value = 0.0; value <= scale.most_y() + 1e-9; value += step) {
    canvas.line({area.left, scale.y(value)}, {area.right, scale.y(value)}, kFaint);
    const std::string label = chart.is_percent ? short_number(100.0 * value) + " %" : short_number(value);
    canvas.text({area.left - 8.0, scale.y(value)}, label, kLabelHeight, kInk, TextAlign::kRight);
  }
  canvas.line({area.left, area.bottom}, {area.right, area.bottom}, kInk);
  double last = -INFINITY;
  for (const double value : x_ticks(chart, scale)) {
    canvas.line({scale.x(value), area.bottom}, {scale.x(value), area.bottom + 5.0}, kInk);
    if (scale.x(value) - last < kTickSpacing) continue;
    last = scale.x(value);
    canvas.text({last, area.bottom + 17.0}, short_number(value), kLabelHeight, kInk, TextAlign::kCentre);
  }
  canvas.text({0.5 * (area.left + area.right), area.bottom + 38.0}, chart.x_label, kLabelHeight, kInk, TextAlign::kCentre);
}

void draw_names(Canvas& canvas, const Box& area, const Chart& chart) {
  double x = area.left;
  for (std::size_t i = 0; i < chart.curves.size(); ++i) {
    canvas.line({x, area.top - 18.0}, {x + 20.0, area.top - 18.0}, curve_colour(i), 3.0);
    canvas.text({x + 26.0, area.top - 18.0}, chart.curves[i].name, kLabelHeight, kInk);
    x += 26.0 + Canvas::text_width(chart.curves[i].name, kLabelHeight) + 22.0;
  }
}

}  // namespace

double round_step(double extent, int most) {
  const double least = std::max(extent, 1e-9) / most;
  const double power = std::pow(10.0, std::floor(std::log10(least)));
  for (const double factor : {1.0, 2.0, 5.0}) {
    if (factor * power >= least) return factor * power;
  }
  return 10.0 * power;
}

Rgb8 curve_colour(std::size_t index) {
  constexpr Rgb8 colours[] = {{0, 114, 178}, {230, 159, 0}, {204, 121, 167}, {86, 180, 233}, {0, 0, 0}, {0, 158, 115}, {213, 94, 0}};
  return colours[index % std::size(colours)];
}

void draw_chart(Canvas& canvas, const Box& box, const Chart& chart) {
  const Box area{box.left + kLeftMargin, box.top + kTopMargin, box.right, box.bottom - kBottomMargin};
  const Scale scale(chart, area);
  canvas.text({box.left, box.top + 10.0}, chart.title, kTitleHeight, kInk);
  draw_names(canvas, area, chart);
  draw_axes(canvas, area, chart, scale);
  for (std::size_t i = chart.curves.size(); i-- > 0;) {  // the first curve on top
    std::vector<cv::Point2d> points;
    for (const auto& [x, y] : chart.curves[i].points) {
      if (std::isfinite(x) && std::isfinite(y)) points.push_back({scale.x(x), scale.y(y)});
    }
    canvas.polyline(points, curve_colour(i), 2.0);
    for (const cv::Point2d& point : points) {
      if (chart.curves[i].has_marks) canvas.disc(point, 3.5, curve_colour(i));
    }
  }
}

}  // namespace foothold::benchmark

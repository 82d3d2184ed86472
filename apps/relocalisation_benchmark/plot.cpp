// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "plot.h"

#include <algorithm>
#include <cmath>

#include "chart.h"
#include "common/canvas.h"
#include "foothold/base/contract.h"
#include "foothold/evaluation/text_table.h"
#include "foothold/io/image_file.h"
#include "trajectory_map.h"

namespace foothold::benchmark {
namespace {

using apps::Canvas;
using apps::TextAlign;

constexpr int kWidth = 1200;
constexpr int kChartHeight = 440;
constexpr double kMostMapHeight = 420.0;
constexpr double kLeastMapHeight = 150.0;
constexpr double kMapHeader = 40.0;  ///< title above the map
constexpr double kMapFooter = 40.0;  ///< scale bar below it
constexpr int kMapsPerRow = 3;
constexpr double kMargin = 24.0;
/// Recall is averaged over this many tests, fewer in short runs.
constexpr int kLongestWindow = 50;

constexpr Rgb8 kFoundColour = {0, 158, 115};
constexpr Rgb8 kWrongColour = {213, 94, 0};
constexpr Rgb8 kLostColour = {110, 110, 110};

std::string with_percent_sign(double fraction) { return format_number(100.0 * fraction, 1) + " %"; }

double found_fraction(const MethodResult& method) {
  const auto is_found = [](const TestRecord& test) { return test.within(kFoundThreshold); };
  const auto num_found = std::count_if(method.log.tests.begin(), method.log.tests.end(), is_found);
  return static_cast<double>(num_found) / static_cast<double>(std::max<std::size_t>(1, method.log.tests.size()));
}

/// Recall over the last `window` tests, at each test.
std::vector<double> moving_recall(const std::vector<TestRecord>& tests, int window) {
  std::vector<double> recall;
  int num_found = 0;
  for (std::size_t i = 0; i < tests.size(); ++i) {
    num_found += tests[i].within(kFoundThreshold) ? 1 : 0;
    const std::size_t leaving = static_cast<std::size_t>(window);
    if (i >= leaving) num_found -= tests[i - leaving].within(kFoundThreshold) ? 1 : 0;
    recall.push_back(static_cast<double>(num_found) / static_cast<double>(std::min(i + 1, leaving)));
  }
  return recall;
}

/// @return The left end of what was drawn [px].
double draw_legend(Canvas& canvas, const BenchmarkResult& result, cv::Point2d right_end) {
  double x = right_end.x;
  for (std::size_t i = result.methods.size(); i-- > 0;) {
    const std::string label = result.methods[i].name + " " + with_percent_sign(found_fraction(result.methods[i]));
    canvas.text({x, right_end.y}, label, kLabelHeight, kInk, TextAlign::kRight);
    x -= Canvas::text_width(label, kLabelHeight) + 8.0;
    canvas.line({x - 22.0, right_end.y}, {x, right_end.y}, curve_colour(i), 3.0);
    x -= 22.0 + 20.0;
  }
  return x;
}

/// The end of a text that is not wider than `width`, after three dots if something was cut off.
std::string shortened(const std::string& words, double height, double width) {
  if (Canvas::text_width(words, height) <= width) return words;
  for (std::size_t first = 1; first < words.size(); ++first) {
    const std::string end = "..." + words.substr(first);
    if (Canvas::text_width(end, height) <= width) return end;
  }
  return {};
}

/// A label on the axis of tests.
struct Tick {
  double position = 0.0;  ///< in tests
  std::string label;
};

/// Round frame numbers where the tests are one stretch of a recording, else the tests' own numbers.
std::vector<Tick> test_ticks(const std::vector<TestRecord>& tests) {
  const auto rises = [](const TestRecord& a, const TestRecord& b) { return a.frame_index < b.frame_index; };
  const bool one_stretch = tests.front().input_index == tests.back().input_index && std::is_sorted(tests.begin(), tests.end(), rises);
  const auto number_of = [&](std::size_t test) {
    return one_stretch ? static_cast<double>(tests[test].frame_index) : static_cast<double>(test);
  };
  const double step = std::max(1.0, round_step(number_of(tests.size() - 1) - number_of(0), 10));
  std::vector<Tick> ticks;
  double next = std::ceil(number_of(0) / step) * step;
  for (std::size_t test = 0; test < tests.size(); ++test) {
    if (number_of(test) < next) continue;
    ticks.push_back({static_cast<double>(test), format_number(number_of(test), 0)});
    next = (std::floor(number_of(test) / step) + 1.0) * step;
  }
  return ticks;
}

/// Axes with percent upwards and tests to the right, labelled with the tested frames' numbers.
void draw_axes(Canvas& canvas, const Box& box, const std::vector<TestRecord>& tests) {
  for (int tick = 0; tick <= 100; tick += 20) {
    const double y = box.bottom - (box.bottom - box.top) * tick / 100.0;
    canvas.line({box.left, y}, {box.right, y}, kFaint);
    canvas.text({box.left - 8.0, y}, std::to_string(tick) + " %", kLabelHeight, kInk, TextAlign::kRight);
  }
  for (const Tick& tick : test_ticks(tests)) {
    const double x = box.left + (box.right - box.left) * tick.position / std::max(1.0, static_cast<double>(tests.size()) - 1.0);
    canvas.line({x, box.bottom}, {x, box.bottom + 5.0}, kInk);
    canvas.text({x, box.bottom + 17.0}, tick.label, kLabelHeight, kInk, TextAlign::kCentre);
  }
  canvas.line({box.left, box.bottom}, {box.right, box.bottom}, kInk);
  canvas.text({0.5 * (box.left + box.right), box.bottom + 38.0}, "tested frame", kLabelHeight, kInk, TextAlign::kCentre);
}

std::string title_of(const BenchmarkResult& result) {
  std::string title = result.protocol + ":";
  for (const std::string& name : result.tested) title += " " + name;
  return title;
}

void draw_recall(Canvas& canvas, const BenchmarkResult& result) {
  const std::vector<TestRecord>& tests = result.methods.front().log.tests;
  const int window = std::clamp(static_cast<int>(tests.size()) / 10, 1, kLongestWindow);
  canvas.text({kMargin, kMargin}, "Found within 5 cm and 5 deg, over the last " + std::to_string(window) + " tests", kTitleHeight, kInk);
  const double legend_left = draw_legend(canvas, result, {kWidth - kMargin, kMargin + 28.0});
  canvas.text({kMargin, kMargin + 28.0}, shortened(title_of(result), kLabelHeight, legend_left - 2.0 * kMargin), kLabelHeight, kInk);
  const Box box{kMargin + 52.0, kMargin + 54.0, kWidth - kMargin, kChartHeight - 58.0};
  draw_axes(canvas, box, tests);
  for (std::size_t i = result.methods.size(); i-- > 0;) {  // the first method on top
    const std::vector<double> recall = moving_recall(result.methods[i].log.tests, window);
    std::vector<cv::Point2d> points;
    for (std::size_t test = 0; test < recall.size(); ++test) {
      const double x =
          box.left + (box.right - box.left) * static_cast<double>(test) / std::max(1.0, static_cast<double>(recall.size()) - 1.0);
      points.push_back({x, box.bottom - (box.bottom - box.top) * recall[test]});
    }
    canvas.polyline(points, curve_colour(i), 2.0);
  }
}

/// The smallest box around points.
Box bounds_of(const std::vector<cv::Point2d>& points) {
  Box bounds{points.front().x, points.front().y, points.front().x, points.front().y};
  for (const cv::Point2d& point : points) {
    bounds = {std::min(bounds.left, point.x), std::min(bounds.top, point.y), std::max(bounds.right, point.x),
              std::max(bounds.bottom, point.y)};
  }
  return bounds;
}

/// Fits points [m] into a box, keeping their proportions.
class MapScale {
 public:
  MapScale(const std::vector<cv::Point2d>& points, const Box& box) : box_(box) {
    const Box bounds_m = bounds_of(points);
    centre_ = {0.5 * (bounds_m.left + bounds_m.right), 0.5 * (bounds_m.top + bounds_m.bottom)};
    constexpr double least_m = 0.01;  // of a camera that stood still
    px_per_m_ = std::min((box.right - box.left) / std::max(bounds_m.right - bounds_m.left, least_m),
                         (box.bottom - box.top) / std::max(bounds_m.bottom - bounds_m.top, least_m));
  }
  cv::Point2d operator()(cv::Point2d point) const {
    return {0.5 * (box_.left + box_.right) + (point.x - centre_.x) * px_per_m_,
            0.5 * (box_.top + box_.bottom) + (point.y - centre_.y) * px_per_m_};
  }
  double px_per_m() const { return px_per_m_; }

 private:
  Box box_;
  cv::Point2d centre_;
  double px_per_m_ = 1.0;
};

void draw_scale_bar(Canvas& canvas, cv::Point2d left_end, double px_per_m) {
  const double length_m = round_step(120.0 / px_per_m, 2);
  const cv::Point2d right_end{left_end.x + length_m * px_per_m, left_end.y};
  canvas.line(left_end, right_end, kInk, 2.0);
  const std::string label = length_m < 1.0 ? format_number(length_m * 100.0, 0) + " cm" : format_number(length_m, 0) + " m";
  canvas.text({right_end.x + 8.0, left_end.y}, label, kLabelHeight, kInk);
}

void draw_map(Canvas& canvas, const MethodResult& method, const std::vector<cv::Point2d>& positions_m, const Box& box) {
  canvas.text({box.left, box.top + 10.0}, method.name + ": " + with_percent_sign(found_fraction(method)) + " found", kTitleHeight, kInk);
  const MapScale scale(positions_m, {box.left + 10.0, box.top + kMapHeader, box.right - 10.0, box.bottom - kMapFooter});
  for (std::size_t i = 1; i < positions_m.size(); ++i) {
    if (method.log.tests[i].input_index == method.log.tests[i - 1].input_index)
      canvas.line(scale(positions_m[i - 1]), scale(positions_m[i]), kFaint);
  }
  for (const bool found : {true, false}) {  // failures on top
    for (std::size_t i = 0; i < positions_m.size(); ++i) {
      const TestRecord& test = method.log.tests[i];
      if (test.within(kFoundThreshold) != found) continue;
      if (found) {
        canvas.disc(scale(positions_m[i]), 2.2, kFoundColour);
      } else {
        canvas.cross(scale(positions_m[i]), 3.5, test.best.has_value() ? kWrongColour : kLostColour);
      }
    }
  }
  draw_scale_bar(canvas, {box.left + 10.0, box.bottom - 14.0}, scale.px_per_m());
}

void draw_map_legend(Canvas& canvas, double y) {
  double x = kMargin;
  const auto label = [&](const std::string& words) {
    canvas.text({x + 10.0, y}, words, kLabelHeight, kInk);
    x += 10.0 + Canvas::text_width(words, kLabelHeight) + 30.0;
  };
  const std::string title = "The trajectory from above";
  canvas.text({x, y}, title, kTitleHeight, kInk);
  x += Canvas::text_width(title, kTitleHeight) + 40.0;
  canvas.disc({x, y}, 4.0, kFoundColour);
  label("found");
  canvas.cross({x, y}, 4.0, kWrongColour);
  label("answered, but off by more");
  canvas.cross({x, y}, 4.0, kLostColour);
  label("no answer");
}

/// The height of a map that its trajectory fills.
double map_height(const std::vector<cv::Point2d>& positions_m, double map_width) {
  const Box bounds_m = bounds_of(positions_m);
  const double aspect = (bounds_m.bottom - bounds_m.top) / std::max(bounds_m.right - bounds_m.left, 1e-6);
  return std::clamp(aspect * map_width + kMapHeader + kMapFooter, kLeastMapHeight, kMostMapHeight);
}

}  // namespace

Image<Rgb8> draw_result(const BenchmarkResult& result) {
  FOOTHOLD_EXPECTS(!result.methods.empty() && !result.methods.front().log.tests.empty());
  const int num_maps = static_cast<int>(result.methods.size());
  const int num_columns = std::min(num_maps, kMapsPerRow);
  const int num_rows = (num_maps + num_columns - 1) / num_columns;
  constexpr double legend_height = 40.0;
  const std::vector<cv::Point2d> positions_m = seen_from_above(result.methods.front().log.tests);
  const double width = (kWidth - kMargin * (num_columns + 1)) / num_columns;
  const double height = map_height(positions_m, width);
  Canvas canvas(kWidth, static_cast<int>(kChartHeight + legend_height + num_rows * height));
  draw_recall(canvas, result);
  draw_map_legend(canvas, kChartHeight + 12.0);
  for (int i = 0; i < num_maps; ++i) {
    const double left = kMargin + (i % num_columns) * (width + kMargin);
    const double top = kChartHeight + legend_height + (i / num_columns) * height;
    draw_map(canvas, result.methods[static_cast<std::size_t>(i)], positions_m, {left, top, left + width, top + height});
  }
  return canvas.image();
}

void write_plot(const std::string& path, const BenchmarkResult& result) { write_png(path, draw_result(result)); }

}  // namespace foothold::benchmark

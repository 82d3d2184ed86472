// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "common/view_panels.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "common/view_style.h"
#include "common/view_warnings.h"
#include "foothold/base/number_text.h"
#include "foothold/io/image_file.h"

namespace foothold::apps {
namespace {

using namespace style;

constexpr double kMargin = 14.0;  // between a panel's border and its content [px]
/// Where the confidence starts in the header: right of the widest state and note [px].
constexpr double kConfidenceX = 500.0;

/// Clamps to [0, 1]; NaN to 0.
double in_unit_range(double value) { return value > 0.0 ? std::min(value, 1.0) : 0.0; }

/// The width of the full bar: the next round number.
double full_scale_ms(double total_ms) {
  for (const double scale : {10.0, 20.0, 50.0, 100.0, 200.0, 500.0, 1000.0, 2000.0}) {
    if (total_ms <= scale) return scale;
  }
  return total_ms;
}

void draw_bar(Canvas& canvas, const cv::Rect& area, double fraction, Rgb8 colour) {
  canvas.fill_rounded(area, area.height / 2, kGroove);
  const auto filled = static_cast<int>(std::lround(in_unit_range(fraction) * area.width));
  if (filled > 0) canvas.fill_rounded({area.x, area.y, std::max(filled, area.height), area.height}, area.height / 2, colour);
}

/// As many pixels of an image as an area shows; depths are never averaged.
Image<float> reduced(const Image<float>& image, cv::Size area) {
  const double step = std::max({1.0, static_cast<double>(image.width()) / area.width, static_cast<double>(image.height()) / area.height});
  Image<float> result(static_cast<int>(image.width() / step), static_cast<int>(image.height() / step));
  for (int v = 0; v < result.height(); ++v) {
    for (int u = 0; u < result.width(); ++u) result(u, v) = image(static_cast<int>((u + 0.5) * step), static_cast<int>((v + 0.5) * step));
  }
  return result;
}

/// A filled pill with words; returns its right end.
int draw_pill(Canvas& canvas, cv::Point corner, int height, const std::string& words, Rgb8 colour) {
  const auto width = static_cast<int>(std::ceil(Canvas::text_width(words, kHeading))) + 36;
  canvas.fill_rounded({corner.x, corner.y, width, height}, height / 2, colour);
  canvas.text({corner.x + 0.5 * width, corner.y + 0.5 * height}, words, kHeading, kDarkText, TextAlign::kCentre);
  return corner.x + width;
}

}  // namespace

void draw_caption(Canvas& canvas, cv::Point corner, const std::string& words) {
  const auto width = static_cast<int>(std::ceil(Canvas::text_width(words, kLabel)));
  canvas.fill_rounded({corner.x + 8, corner.y + 8, width + 16, 22}, 4, kBackground, 0.75);
  canvas.text({corner.x + 16.0, corner.y + 19.0}, words, kLabel, kText);
}

void draw_header(Canvas& canvas, const cv::Rect& area, const ViewContents& contents) {
  const double middle = area.y + 0.5 * area.height;
  const int pill_y = area.y + area.height / 2 - 16;
  int x = draw_pill(canvas, {area.x, pill_y}, 32, name_of(contents.state), colour_of(contents.state));
  if (contents.relocalised) x = draw_pill(canvas, {x + 10, pill_y}, 32, "RELOCALISED", kBlue);
  const double note_width = kConfidenceX - 16.0 - (x + 14.0);
  canvas.text({x + 14.0, middle}, Canvas::shortened(contents.state_note, kBody, note_width), kBody, kDimText);

  canvas.text({kConfidenceX, middle}, "confidence", kBody, kDimText);
  const int bar_x = static_cast<int>(kConfidenceX) + 98;
  draw_bar(canvas, {bar_x, static_cast<int>(middle) - 5, 180, 10}, contents.confidence, colour_of(contents.state));
  canvas.text({bar_x + 192.0, middle}, fixed_text(contents.confidence, 2), kBody, kText);

  const double right = area.x + area.width;
  const double title_width = right - (bar_x + 260.0);
  canvas.text({right, middle - 10.0}, Canvas::shortened(with_short_paths(contents.title), kBody, title_width), kBody, kText,
              TextAlign::kRight);
  canvas.text({right, middle + 10.0}, contents.frame_text, kLabel, kDimText, TextAlign::kRight);
}

void draw_picture(Canvas& canvas, const cv::Rect& area, const Image<Rgb8>& image, const std::string& caption, double brightness) {
  canvas.fill(area, kPanel);
  if (image.empty()) {
    canvas.text({area.x + 0.5 * area.width, area.y + 0.5 * area.height}, "nothing yet", kBody, kDimText, TextAlign::kCentre);
  }
  canvas.picture(area, image, brightness);
  draw_caption(canvas, area.tl(), caption);
}

void draw_advice(Canvas& canvas, const cv::Rect& area, const std::vector<std::string>& lines) {
  constexpr int kLine = 28;
  const int height = kLine * static_cast<int>(lines.size());
  if (lines.empty()) return;
  canvas.fill_rounded({area.x + 8, area.y + area.height - height - 16, area.width - 16, height + 8}, 4, kBackground, 0.75);
  double y = area.y + area.height - height - 12.0 + 0.5 * kLine;
  for (const std::string& line : lines) {
    canvas.text({area.x + 0.5 * area.width, y}, Canvas::shortened(line, kBody, area.width - 32.0), kBody, kAmber, TextAlign::kCentre);
    y += kLine;
  }
}

void draw_depth(Canvas& canvas, const cv::Rect& area, const ViewContents& contents) {
  const Image<float> shown = reduced(contents.depth_m, area.size());
  const Image<Rgb8> coloured = shown.empty() ? Image<Rgb8>() : colourise_depth(shown, 0.0F, contents.max_depth_m);
  draw_picture(canvas, area, coloured, "depth");
  constexpr int kWidth = 120;
  const cv::Rect box(area.x + area.width - kWidth - 70, area.y + 8, kWidth + 62, 22);
  canvas.fill_rounded(box, 4, kBackground, 0.75);
  Image<float> ramp(kWidth, 1);
  for (int u = 0; u < kWidth; ++u) ramp(u, 0) = contents.max_depth_m * (static_cast<float>(u) + 0.5F) / kWidth;
  const Image<Rgb8> code = colourise_depth(ramp, 0.0F, contents.max_depth_m);
  for (int u = 0; u < kWidth; ++u) canvas.fill({box.x + 20 + u, box.y + 7, 1, 8}, code(u, 0));
  canvas.text({box.x + 8.0, box.y + 11.0}, "0", kLabel, kText);
  canvas.text({box.x + 20.0 + kWidth + 6.0, box.y + 11.0}, fixed_text(contents.max_depth_m, 0) + " m", kLabel, kText);
}

void draw_timings(Canvas& canvas, const cv::Rect& area, const ViewContents& contents) {
  canvas.fill_rounded(area, kRadius, kPanel);
  const double left = area.x + kMargin;
  const double right = area.x + area.width - kMargin;
  canvas.text({left, area.y + 20.0}, "time of a frame", kBody, kText);
  if (contents.frames_per_second > 0.0) {
    canvas.text({right, area.y + 20.0}, fixed_text(contents.frames_per_second, 1) + " frames/s", kBody, kText, TextAlign::kRight);
  }
  const double scale = full_scale_ms(std::max(contents.total_ms, contents.view_ms));
  const double top = area.y + 46.0;
  const double step = std::min(30.0, (area.height - 46.0 - 8.0) / static_cast<double>(contents.timings.size() + 2));
  const auto row = [&](std::size_t index, const ViewTiming& timing, Rgb8 colour) {
    const double y = top + step * static_cast<double>(index);
    canvas.text({left, y}, timing.name, kLabel, kDimText);
    draw_bar(canvas, {static_cast<int>(left) + 86, static_cast<int>(y) - 4, static_cast<int>(right - left) - 86 - 78, 8}, timing.ms / scale,
             colour);
    canvas.text({right, y}, fixed_text(timing.ms, 1) + " ms", kLabel, kText, TextAlign::kRight);
  };
  for (std::size_t i = 0; i < contents.timings.size(); ++i) row(i, contents.timings[i], kBlue);
  if (contents.timings.empty()) return;
  row(contents.timings.size(), {"all", contents.total_ms}, kText);
  if (contents.view_ms > 0.0) row(contents.timings.size() + 1, {"this view", contents.view_ms}, kGrey);
}

void draw_history(Canvas& canvas, const cv::Rect& area, const std::vector<ViewMoment>& history) {
  canvas.fill_rounded(area, kRadius, kPanel);
  canvas.text({area.x + kMargin, area.y + 20.0}, "confidence and state of the last frames", kBody, kText);
  const cv::Rect plot(area.x + 42, area.y + 44, area.width - 42 - static_cast<int>(kMargin), area.height - 44 - 50);
  for (const double level : {0.0, 0.5, 1.0}) {
    const double y = plot.y + (1.0 - level) * plot.height;
    canvas.line({static_cast<double>(plot.x), y}, {static_cast<double>(plot.x + plot.width), y}, kGroove);
    canvas.text({plot.x - 8.0, y}, fixed_text(level, 1), kLabel, kDimText, TextAlign::kRight);
  }
  const double step = 2.0;  // pixels a frame
  const auto num_shown = std::min(history.size(), static_cast<std::size_t>(plot.width / step));
  const std::size_t first = history.size() - num_shown;
  const auto at = [&](std::size_t i) {
    const double x = plot.x + plot.width - step * static_cast<double>(num_shown - i);
    return cv::Point2d(x, plot.y + (1.0 - in_unit_range(history[first + i].confidence)) * plot.height);
  };
  for (std::size_t i = 0; i < num_shown; ++i) {
    const ViewMoment& moment = history[first + i];
    const auto x = static_cast<int>(at(i).x);
    if (moment.event) canvas.fill({x, plot.y, 1, plot.height + 14}, kText);
    canvas.fill({x, plot.y + plot.height + 6, static_cast<int>(step), 8}, colour_of(moment.state));
    if (i > 0) canvas.line(at(i - 1), at(i), colour_of(moment.state));
  }
  for (std::size_t i = 0; i < num_shown; ++i) {
    if (history[first + i].relocalised) canvas.disc({at(i).x, plot.y + plot.height + 10.0}, 5.0, kBlue);
  }
  double x = plot.x;
  const double y = area.y + area.height - 16.0;
  for (const auto& [name, colour] : {std::pair<const char*, Rgb8>{"tracking", kGreen},
                                     {"settling", kAmber},
                                     {"lost", kRed},
                                     {"relocalised", kBlue},
                                     {"camera moved", kText}}) {
    canvas.disc({x + 4.0, y}, 4.0, colour);
    canvas.text({x + 13.0, y}, name, kLabel, kDimText);
    x += Canvas::text_width(name, kLabel) + 29.0;
  }
}

void draw_footer(Canvas& canvas, const cv::Rect& area, const ViewContents& contents) {
  const double middle = area.y + 0.5 * area.height;
  double right = area.x + area.width;
  if (!contents.keys.empty()) {
    canvas.text({right, middle}, "H  keys", kLabel, kDimText, TextAlign::kRight);
    right -= Canvas::text_width("H  keys", kLabel) + 24.0;
  }
  canvas.text({right, middle}, contents.counters, kLabel, kDimText, TextAlign::kRight);
  const double width = right - Canvas::text_width(contents.counters, kLabel) - 24.0 - area.x;
  canvas.text({static_cast<double>(area.x), middle}, Canvas::shortened(contents.notice, kBody, width), kBody, kText);
}

void draw_help(Canvas& canvas, const std::vector<ViewKey>& keys) {
  constexpr double kRow = 30.0;
  double key_width = 40.0;
  double meaning_width = Canvas::text_width("Any other key closes this", kBody);
  for (const ViewKey& key : keys) {
    key_width = std::max(key_width, Canvas::text_width(key.key, kBody) + 20.0);
    meaning_width = std::max(meaning_width, Canvas::text_width(key.meaning, kBody));
  }
  const cv::Size all = canvas.pixels().size();
  canvas.fill_rounded({0, 0, all.width, all.height}, 0, kBackground, 0.6);
  const auto width = static_cast<int>(key_width + meaning_width + 84.0);
  const auto height = static_cast<int>(kRow * static_cast<double>(keys.size()) + 76.0);
  const cv::Rect box((all.width - width) / 2, (all.height - height) / 2, width, height);
  canvas.fill_rounded(box, 10, kPanel);
  canvas.text({box.x + 28.0, box.y + 30.0}, "Keys", kHeading, kText);
  double y = box.y + 72.0;
  for (const ViewKey& key : keys) {
    canvas.fill_rounded({box.x + 28, static_cast<int>(y) - 12, static_cast<int>(key_width), 24}, 4, kGroove);
    canvas.text({box.x + 28.0 + 0.5 * key_width, y}, key.key, kBody, kText, TextAlign::kCentre);
    canvas.text({box.x + 28.0 + key_width + 18.0, y}, key.meaning, kBody, kText);
    y += kRow;
  }
}

}  // namespace foothold::apps

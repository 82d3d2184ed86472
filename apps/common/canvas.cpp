// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "common/canvas.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

namespace foothold::apps {
namespace {

/// OpenCV draws at fractions of a pixel: coordinates carry this many fractional bits.
constexpr int kFractionBits = 4;
/// Text is drawn this much larger and averaged down, which smooths it.
constexpr int kTextOversampling = 4;
constexpr int kFont = cv::FONT_HERSHEY_SIMPLEX;
/// Height of a capital of the font at scale 1 [px].
constexpr double kFontHeight = 21.0;
/// Stroke width of text relative to its height.
constexpr double kFontWeight = 0.125;

int fixed(double value) { return static_cast<int>(std::lround(value * (1 << kFractionBits))); }
cv::Point fixed(cv::Point2d point) { return {fixed(point.x), fixed(point.y)}; }

struct TextSize {
  double scale = 1.0;
  int stroke = 1;
  cv::Size size;  // in oversampled pixels
  int baseline = 0;
};

TextSize measure(const std::string& words, double height) {
  TextSize result;
  result.scale = height * kTextOversampling / kFontHeight;
  result.stroke = std::max(1, static_cast<int>(std::lround(kFontWeight * height * kTextOversampling)));
  result.size = cv::getTextSize(words, kFont, result.scale, result.stroke, &result.baseline);
  return result;
}

/// Blends a colour over an area, weighted by an 8-bit mask of its size.
void blend(cv::Mat& pixels, const cv::Rect& area, const cv::Mat& mask, Rgb8 colour, double opacity) {
  const cv::Rect inside = area & cv::Rect(0, 0, pixels.cols, pixels.rows);
  const int channels[3] = {colour.b, colour.g, colour.r};
  const int weight = static_cast<int>(std::lround(opacity * 256.0));
  for (int y = inside.y; y < inside.y + inside.height; ++y) {
    auto* pixel = pixels.ptr<cv::Vec3b>(y);
    const auto* alpha = mask.ptr<std::uint8_t>(y - area.y);
    for (int x = inside.x; x < inside.x + inside.width; ++x) {
      const int a = alpha[x - area.x] * weight / 256;
      if (a == 0) continue;
      for (int c = 0; c < 3; ++c) {
        const int below = pixel[x][c];
        pixel[x][c] = static_cast<std::uint8_t>(below + (channels[c] - below) * a / 255);
      }
    }
  }
}

}  // namespace

cv::Scalar bgr(Rgb8 colour) { return {static_cast<double>(colour.b), static_cast<double>(colour.g), static_cast<double>(colour.r)}; }

Canvas::Canvas(int width, int height, Rgb8 background) : pixels_(height, width, CV_8UC3, bgr(background)) {}

void Canvas::fill(const cv::Rect& area, Rgb8 colour) { cv::rectangle(pixels_, area, bgr(colour), cv::FILLED); }

void Canvas::fill_rounded(const cv::Rect& area, int radius, Rgb8 colour, double opacity) {
  const int r = std::min({radius, area.width / 2, area.height / 2});
  cv::Mat mask(area.height, area.width, CV_8U, cv::Scalar(0.0));
  cv::rectangle(mask, {r, 0, area.width - 2 * r, area.height}, 255.0, cv::FILLED);
  cv::rectangle(mask, {0, r, area.width, area.height - 2 * r}, 255.0, cv::FILLED);
  for (const cv::Point2d corner : {cv::Point2d(r, r), cv::Point2d(area.width - 1 - r, r), cv::Point2d(r, area.height - 1 - r),
                                   cv::Point2d(area.width - 1 - r, area.height - 1 - r)}) {
    cv::circle(mask, fixed(corner), fixed(r), 255.0, cv::FILLED, cv::LINE_AA, kFractionBits);
  }
  blend(pixels_, area, mask, colour, opacity);
}

void Canvas::line(cv::Point2d from, cv::Point2d to, Rgb8 colour, double thickness) {
  cv::line(pixels_, fixed(from), fixed(to), bgr(colour), std::max(1, static_cast<int>(std::lround(thickness))), cv::LINE_AA, kFractionBits);
}

void Canvas::polyline(const std::vector<cv::Point2d>& points, Rgb8 colour, double thickness) {
  for (std::size_t i = 1; i < points.size(); ++i) line(points[i - 1], points[i], colour, thickness);
}

void Canvas::disc(cv::Point2d centre, double radius, Rgb8 colour) {
  cv::circle(pixels_, fixed(centre), fixed(radius), bgr(colour), cv::FILLED, cv::LINE_AA, kFractionBits);
}

void Canvas::ring(cv::Point2d centre, double radius, Rgb8 colour, double thickness) {
  cv::circle(pixels_, fixed(centre), fixed(radius), bgr(colour), std::max(1, static_cast<int>(std::lround(thickness))), cv::LINE_AA,
             kFractionBits);
}

void Canvas::cross(cv::Point2d centre, double radius, Rgb8 colour) {
  line({centre.x - radius, centre.y - radius}, {centre.x + radius, centre.y + radius}, colour, 1.5);
  line({centre.x - radius, centre.y + radius}, {centre.x + radius, centre.y - radius}, colour, 1.5);
}

void Canvas::polygon(const std::vector<cv::Point2d>& corners, Rgb8 colour) {
  std::vector<cv::Point> points;
  points.reserve(corners.size());
  for (const cv::Point2d& corner : corners) points.push_back(fixed(corner));
  cv::fillConvexPoly(pixels_, points, bgr(colour), cv::LINE_AA, kFractionBits);
}

void Canvas::picture(const cv::Rect& area, const Image<Rgb8>& image, double brightness) {
  if (image.empty()) return;
  const double scale = std::min(static_cast<double>(area.width) / image.width(), static_cast<double>(area.height) / image.height());
  const cv::Size size(std::min(area.width, std::max(1, static_cast<int>(std::lround(image.width() * scale)))),
                      std::min(area.height, std::max(1, static_cast<int>(std::lround(image.height() * scale)))));
  const cv::Mat rgb(image.height(), image.width(), CV_8UC3, const_cast<Rgb8*>(image.data()));  // NOLINT: cv::Mat has no const view
  cv::Mat resized;
  cv::resize(rgb, resized, size, 0.0, 0.0, scale < 1.0 ? cv::INTER_AREA : cv::INTER_CUBIC);
  cv::cvtColor(resized, resized, cv::COLOR_RGB2BGR);
  if (brightness < 1.0) resized *= brightness;
  resized.copyTo(pixels_(cv::Rect({area.x + (area.width - size.width) / 2, area.y + (area.height - size.height) / 2}, size)));
}

void Canvas::text(cv::Point2d anchor, const std::string& words, double height, Rgb8 colour, TextAlign align) {
  if (words.empty()) return;
  const TextSize measured = measure(words, height);
  const double shift = align == TextAlign::kLeft ? 0.0 : align == TextAlign::kCentre ? 0.5 : 1.0;
  const double left = anchor.x - shift * measured.size.width / kTextOversampling;
  const int margin = 2;  // [px] for strokes that reach beyond the letters' box
  const int capital = static_cast<int>(std::ceil(height));
  const cv::Rect area(static_cast<int>(std::floor(left)) - margin, static_cast<int>(std::lround(anchor.y - 0.5 * height)) - margin,
                      measured.size.width / kTextOversampling + 2 * margin + 1,
                      capital + 2 * margin + measured.baseline / kTextOversampling + 1);
  cv::Mat large(area.height * kTextOversampling, area.width * kTextOversampling, CV_8U, cv::Scalar(0.0));
  const cv::Point origin(static_cast<int>(std::lround((left - area.x) * kTextOversampling)),
                         static_cast<int>(std::lround((anchor.y + 0.5 * height - area.y) * kTextOversampling)));
  cv::putText(large, words, origin, kFont, measured.scale, 255.0, measured.stroke, cv::LINE_AA);
  cv::Mat mask;
  cv::resize(large, mask, area.size(), 0.0, 0.0, cv::INTER_AREA);
  blend(pixels_, area, mask, colour, 1.0);
}

double Canvas::text_width(const std::string& words, double height) {
  return static_cast<double>(measure(words, height).size.width) / kTextOversampling;
}

std::string Canvas::shortened(const std::string& words, double height, double max_width) {
  if (text_width(words, height) <= max_width) return words;
  std::string kept = words;
  while (!kept.empty() && text_width(kept + "...", height) > max_width) kept.pop_back();
  return kept + "...";
}

Image<Rgb8> Canvas::image() const {
  Image<Rgb8> image(pixels_.cols, pixels_.rows);
  cv::Mat rgb(image.height(), image.width(), CV_8UC3, image.data());
  cv::cvtColor(pixels_, rgb, cv::COLOR_BGR2RGB);
  return image;
}

}  // namespace foothold::apps

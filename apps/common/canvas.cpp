// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "common/canvas.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

namespace foothold::apps {
namespace {

/// How much larger everything is drawn than it is shown.
constexpr int kOversampling = 2;
/// OpenCV draws at fractions of a pixel: coordinates carry this many fractional bits.
constexpr int kFractionBits = 4;
constexpr int kFont = cv::FONT_HERSHEY_SIMPLEX;
/// Height of a capital of the font at scale 1 [px].
constexpr double kFontHeight = 21.0;
/// Stroke width of text relative to its height.
constexpr double kFontWeight = 0.12;

cv::Point fixed_point(Point point) {
  constexpr double scale = kOversampling * (1 << kFractionBits);
  return {static_cast<int>(std::lround(point.x * scale)), static_cast<int>(std::lround(point.y * scale))};
}

cv::Scalar scalar(Rgb8 colour) { return {static_cast<double>(colour.r), static_cast<double>(colour.g), static_cast<double>(colour.b)}; }

int stroke(double thickness) { return std::max(1, static_cast<int>(std::lround(thickness * kOversampling))); }

}  // namespace

Canvas::Canvas(int width, int height) : pixels_(height * kOversampling, width * kOversampling, CV_8UC3, cv::Scalar::all(255.0)) {}

void Canvas::line(Point from, Point to, Rgb8 colour, double thickness) {
  cv::line(pixels_, fixed_point(from), fixed_point(to), scalar(colour), stroke(thickness), cv::LINE_AA, kFractionBits);
}

void Canvas::polyline(const std::vector<Point>& points, Rgb8 colour, double thickness) {
  for (std::size_t i = 1; i < points.size(); ++i) line(points[i - 1], points[i], colour, thickness);
}

void Canvas::disc(Point centre, double radius, Rgb8 colour) {
  const int fixed_radius = static_cast<int>(std::lround(radius * kOversampling * (1 << kFractionBits)));
  cv::circle(pixels_, fixed_point(centre), fixed_radius, scalar(colour), cv::FILLED, cv::LINE_AA, kFractionBits);
}

void Canvas::cross(Point centre, double radius, Rgb8 colour) {
  line({centre.x - radius, centre.y - radius}, {centre.x + radius, centre.y + radius}, colour, 1.5);
  line({centre.x - radius, centre.y + radius}, {centre.x + radius, centre.y - radius}, colour, 1.5);
}

void Canvas::text(Point anchor, const std::string& words, double height, Rgb8 colour, Align align) {
  const double scale = height * kOversampling / kFontHeight;
  const double shift = align == Align::kLeft ? 0.0 : align == Align::kCentre ? 0.5 : 1.0;
  const double left = anchor.x - shift * text_width(words, height);
  const cv::Point origin(static_cast<int>(std::lround(left * kOversampling)),
                         static_cast<int>(std::lround((anchor.y + 0.5 * height) * kOversampling)));
  cv::putText(pixels_, words, origin, kFont, scale, scalar(colour), stroke(kFontWeight * height), cv::LINE_AA);
}

double Canvas::text_width(const std::string& words, double height) {
  int baseline = 0;
  const double scale = height * kOversampling / kFontHeight;
  return static_cast<double>(cv::getTextSize(words, kFont, scale, stroke(kFontWeight * height), &baseline).width) / kOversampling;
}

Image<Rgb8> Canvas::image() const {
  Image<Rgb8> image(pixels_.cols / kOversampling, pixels_.rows / kOversampling);
  cv::Mat shown(image.height(), image.width(), CV_8UC3, image.data());
  cv::resize(pixels_, shown, shown.size(), 0.0, 0.0, cv::INTER_AREA);
  return image;
}

}  // namespace foothold::apps

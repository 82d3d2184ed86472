// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// Draws smooth lines, marks and text in colour: a thin layer over OpenCV's drawing.
#pragma once

#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include "foothold/base/image.h"

namespace foothold::apps {

struct Point {
  double x = 0.0;
  double y = 0.0;
};

enum class Align { kLeft, kCentre, kRight };

/// A white picture with the origin at its top left [px]. Everything is drawn at twice the size and averaged down, which smooths edges and
/// text.
class Canvas {
 public:
  Canvas(int width, int height);

  void line(Point from, Point to, Rgb8 colour, double thickness = 1.0);
  void polyline(const std::vector<Point>& points, Rgb8 colour, double thickness = 1.0);
  void disc(Point centre, double radius, Rgb8 colour);
  /// A diagonal cross, `radius` in each direction.
  void cross(Point centre, double radius, Rgb8 colour);
  /// Text whose vertical middle is at `anchor`. @param height  of a capital letter.
  void text(Point anchor, const std::string& words, double height, Rgb8 colour, Align align = Align::kLeft);
  /// The width that text() needs.
  static double text_width(const std::string& words, double height);

  Image<Rgb8> image() const;

 private:
  cv::Mat pixels_;
};

}  // namespace foothold::apps

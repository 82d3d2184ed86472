// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// Drawing on a picture with smooth edges and smooth text.
#pragma once

#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include "foothold/base/image.h"

namespace foothold::apps {

enum class TextAlign { kLeft, kCentre, kRight };

/// A picture that is drawn on, its origin at the top left [px]; stored as BGR, as OpenCV shows and writes it.
class Canvas {
 public:
  Canvas(int width, int height, Rgb8 background = {255, 255, 255});

  void fill(const cv::Rect& area, Rgb8 colour);
  /// A rectangle with round corners, blended over what is there. @param opacity  [0, 1]
  void fill_rounded(const cv::Rect& area, int radius, Rgb8 colour, double opacity = 1.0);
  void line(cv::Point2d from, cv::Point2d to, Rgb8 colour, double thickness = 1.0);
  void polyline(const std::vector<cv::Point2d>& points, Rgb8 colour, double thickness = 1.0);
  void disc(cv::Point2d centre, double radius, Rgb8 colour);
  void ring(cv::Point2d centre, double radius, Rgb8 colour, double thickness = 1.5);
  /// A diagonal cross, `radius` in each direction.
  void cross(cv::Point2d centre, double radius, Rgb8 colour);
  void polygon(const std::vector<cv::Point2d>& corners, Rgb8 colour);
  /// A picture fitted into an area, keeping its proportions and centred. @param brightness  [0, 1]
  void picture(const cv::Rect& area, const Image<Rgb8>& image, double brightness = 1.0);
  /// Text whose vertical middle (of a capital letter) is at `anchor`. @param height  of a capital letter.
  void text(cv::Point2d anchor, const std::string& words, double height, Rgb8 colour, TextAlign align = TextAlign::kLeft);
  /// The width that text() needs.
  static double text_width(const std::string& words, double height);
  /// The words, or as many as fit followed by "...".
  static std::string shortened(const std::string& words, double height, double max_width);

  Image<Rgb8> image() const;
  cv::Mat& pixels() { return pixels_; }
  const cv::Mat& pixels() const { return pixels_; }

 private:
  cv::Mat pixels_;
};

/// OpenCV's order of channels.
cv::Scalar bgr(Rgb8 colour);

}  // namespace foothold::apps

// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// Charts of curves over one quantity.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "common/canvas.h"

namespace foothold::benchmark {

// How all charts look.
inline constexpr double kTitleHeight = 13.0;  ///< of letters [px]
inline constexpr double kLabelHeight = 10.0;  ///< of letters [px]
inline constexpr Rgb8 kInk = {40, 40, 40};
inline constexpr Rgb8 kFaint = {222, 222, 222};

/// An area of a picture [px].
struct Box {
  double left = 0.0;
  double top = 0.0;
  double right = 0.0;
  double bottom = 0.0;
};

/// A round step that divides [0, extent] into at most `most` parts: 1, 2 or 5 times a power of ten.
double round_step(double extent, int most);

/// A colour for each of a few curves, told apart by people who are colour blind too. Reference: [Okabe2008].
Rgb8 curve_colour(std::size_t index);

struct Curve {
  std::string name;
  std::vector<std::pair<double, double>> points;  ///< (x, y) by rising x; those that are not finite are left out
  bool has_marks = true;                          ///< a disc at every point
};

struct Chart {
  std::string title;
  std::string x_label;
  std::vector<Curve> curves;
  double most_y = 0.0;      ///< upper end of the axis, which begins at 0; 0: what the curves need
  bool is_percent = false;  ///< y is a fraction, shown in percent
  bool is_log_x = false;    ///< x, at least 0, is drawn as log(1 + x), with a tick at every point's x
};

/// Draws axes, curves and their names into an area of a canvas.
void draw_chart(apps::Canvas& canvas, const Box& box, const Chart& chart);

}  // namespace foothold::benchmark

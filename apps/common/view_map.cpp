// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include <algorithm>
#include <cmath>
#include <limits>

#include "common/view_panels.h"
#include "common/view_style.h"
#include "foothold/base/number_text.h"

namespace foothold::apps {
namespace {

using namespace style;

/// Squares are drawn this much larger, so that a turned grid has no cracks.
constexpr double kCellOverlap = 1.4;

struct Bounds {
  double min_x = std::numeric_limits<double>::max();
  double min_y = std::numeric_limits<double>::max();
  double max_x = std::numeric_limits<double>::lowest();
  double max_y = std::numeric_limits<double>::lowest();

  void add(double x, double y) {
    min_x = std::min(min_x, x);
    min_y = std::min(min_y, y);
    max_x = std::max(max_x, x);
    max_y = std::max(max_y, y);
  }
  bool empty() const { return min_x > max_x; }
};

Bounds bounds_of(const MapContents& map) {
  Bounds bounds;
  for (const MapCell& cell : map.cells) bounds.add(cell.x_m, cell.y_m);
  for (const MapStop& stop : map.trajectory) bounds.add(stop.x_m, stop.y_m);
  if (map.camera.has_value()) bounds.add(map.camera->x_m, map.camera->y_m);
  return bounds;
}

/// Metres of the map to pixels of the picture.
struct Projection {
  double scale = 1.0;  // px per m
  cv::Point2d origin;  // where (0, 0) lies

  cv::Point2d operator()(double x_m, double y_m) const { return {origin.x + scale * x_m, origin.y + scale * y_m}; }
};

Projection fit(const Bounds& bounds, const cv::Rect& area) {
  constexpr double kMinExtent_m = 1.0;
  constexpr double kBorder_px = 18.0;
  const double width = std::max(bounds.max_x - bounds.min_x, kMinExtent_m);
  const double height = std::max(bounds.max_y - bounds.min_y, kMinExtent_m);
  Projection projection;
  projection.scale = std::min((area.width - 2.0 * kBorder_px) / width, (area.height - 2.0 * kBorder_px) / height);
  projection.origin = {area.x + 0.5 * area.width - projection.scale * 0.5 * (bounds.min_x + bounds.max_x),
                       area.y + 0.5 * area.height - projection.scale * 0.5 * (bounds.min_y + bounds.max_y)};
  return projection;
}

/// Dims a colour so that the trajectory stands out.
Rgb8 muted(Rgb8 colour) {
  const auto dim = [](std::uint8_t c) { return static_cast<std::uint8_t>(24 + c * 5 / 8); };
  return {dim(colour.r), dim(colour.g), dim(colour.b)};
}

void draw_camera(Canvas& canvas, const Projection& to_pixel, const MapCamera& camera) {
  constexpr double kLength_px = 22.0;
  constexpr double kHalfWidth_px = 12.0;
  const cv::Point2d at = to_pixel(camera.x_m, camera.y_m);
  const cv::Point2d forward(camera.forward_x, camera.forward_y);
  const cv::Point2d side(-forward.y, forward.x);
  const cv::Point2d far = at + kLength_px * forward;
  const std::vector<cv::Point2d> corners = {at, far + kHalfWidth_px * side, far - kHalfWidth_px * side};
  const Rgb8 colour = camera.is_current ? kText : kRed;
  if (camera.is_current) canvas.polygon(corners, colour);
  for (std::size_t i = 0; i < corners.size(); ++i) canvas.line(corners[i], corners[(i + 1) % corners.size()], colour, 2.0);
}

void draw_scale(Canvas& canvas, const cv::Rect& area, double px_per_m) {
  double length_m = 1.0;
  for (const double candidate_m : {5.0, 2.0, 1.0, 0.5, 0.2, 0.1}) {
    length_m = candidate_m;
    if (candidate_m * px_per_m <= 0.35 * area.width) break;
  }
  const std::string words = general_text(length_m, 6) + " m";
  const double right = area.x + area.width - 16.0;
  const double left = right - length_m * px_per_m;
  const double y = area.y + area.height - 14.0;
  canvas.fill_rounded({static_cast<int>(left) - 8, static_cast<int>(y) - 20, static_cast<int>(right - left) + 16, 28}, 4, kBackground,
                      0.75);
  canvas.line({left, y}, {right, y}, kText, 2.0);
  canvas.text({0.5 * (left + right), y - 10.0}, words, kLabel, kText, TextAlign::kCentre);
}

}  // namespace

void draw_map(Canvas& canvas, const cv::Rect& area, const MapContents& map) {
  canvas.fill(area, kPanel);
  const Bounds bounds = bounds_of(map);
  if (bounds.empty()) {
    draw_picture(canvas, area, {}, "map from above");
    return;
  }
  const Projection to_pixel = fit(bounds, area);
  Canvas inside(area.width, area.height, kPanel);  // what sticks out is cut off
  Projection local = to_pixel;
  local.origin -= cv::Point2d(area.tl());
  const int size = std::max(1, static_cast<int>(std::ceil(kCellOverlap * map.cell_m * local.scale)));
  for (const MapCell& cell : map.cells) {
    const cv::Point2d centre = local(cell.x_m, cell.y_m);
    inside.fill({static_cast<int>(std::floor(centre.x - 0.5 * size)), static_cast<int>(std::floor(centre.y - 0.5 * size)), size, size},
                muted(cell.colour));
  }
  for (std::size_t i = 1; i < map.trajectory.size(); ++i) {
    const MapStop& from = map.trajectory[i - 1];
    const MapStop& to = map.trajectory[i];
    if (to.joined) inside.line(local(from.x_m, from.y_m), local(to.x_m, to.y_m), colour_of(to.state), 2.0);
  }
  for (const MapStop& stop : map.trajectory) {
    if (!stop.relocalised) continue;
    inside.disc(local(stop.x_m, stop.y_m), 5.0, kBlue);
    inside.ring(local(stop.x_m, stop.y_m), 5.0, kText, 1.0);
  }
  if (map.camera.has_value()) draw_camera(inside, local, *map.camera);
  inside.pixels().copyTo(canvas.pixels()(area));
  draw_caption(canvas, area.tl(), "map from above");
  draw_scale(canvas, area, to_pixel.scale);
}

}  // namespace foothold::apps

// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "common/view_picture.h"

#include "common/view_panels.h"
#include "common/view_style.h"
#include "common/view_warnings.h"

namespace foothold::apps {
namespace {

// Where the parts lie [px]: pictures of the camera on the left, the map beside them, numbers below the map.
constexpr int kEdge = 16;
constexpr int kGap = 12;
constexpr int kHeaderHeight = 60;
constexpr int kFooterHeight = 40;
constexpr int kCameraWidth = 404;
constexpr int kCameraHeight = 304;
constexpr int kModelWidth = 480;
constexpr int kModelHeight = 360;
constexpr int kTimingsWidth = 290;

constexpr int kTop = kHeaderHeight;
constexpr int kModelX = kEdge + kCameraWidth + kGap;
constexpr int kMapX = kModelX + kModelWidth + kGap;
constexpr int kLowerY = kTop + kModelHeight + kGap;
constexpr int kBottom = kTop + 2 * kCameraHeight + kGap;
constexpr int kHistoryX = kModelX + kTimingsWidth + kGap;
constexpr int kShortHistoryHeight = 126;  // with warnings below
constexpr int kRight = kViewWidth - kEdge;
static_assert(kBottom + kFooterHeight <= kViewHeight, "the parts fit");

/// A map seen from where the camera was, not is, is darker.
constexpr double kStaleBrightness = 0.45;

}  // namespace

cv::Mat compose_view(const ViewContents& contents) {
  Canvas canvas(kViewWidth, kViewHeight, style::kBackground);
  draw_header(canvas, {kEdge, 0, kRight - kEdge, kHeaderHeight}, contents);
  draw_picture(canvas, {kEdge, kTop, kCameraWidth, kCameraHeight}, contents.colour, "colour");
  draw_depth(canvas, {kEdge, kTop + kCameraHeight + kGap, kCameraWidth, kCameraHeight}, contents);
  draw_picture(canvas, {kModelX, kTop, kModelWidth, kModelHeight}, contents.model, contents.model_caption,
               contents.model_is_current ? 1.0 : kStaleBrightness);
  draw_advice(canvas, {kModelX, kTop, kModelWidth, kModelHeight}, contents.advice);
  draw_map(canvas, {kMapX, kTop, kRight - kMapX, kModelHeight}, contents.map);
  draw_timings(canvas, {kModelX, kLowerY, kTimingsWidth, kBottom - kLowerY}, contents);
  const int history_height = contents.warnings.empty() ? kBottom - kLowerY : kShortHistoryHeight;
  draw_history(canvas, {kHistoryX, kLowerY, kRight - kHistoryX, history_height}, contents.history);
  if (!contents.warnings.empty()) {
    const int y = kLowerY + kShortHistoryHeight + kGap;
    draw_warnings(canvas, {kHistoryX, y, kRight - kHistoryX, kBottom - y}, contents.warnings);
  }
  draw_footer(canvas, {kEdge, kViewHeight - kFooterHeight, kRight - kEdge, kFooterHeight}, contents);
  if (contents.show_help) draw_help(canvas, contents.keys);
  return canvas.pixels();
}

}  // namespace foothold::apps

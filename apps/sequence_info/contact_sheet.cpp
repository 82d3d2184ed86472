// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "contact_sheet.h"

#include <algorithm>
#include <cstdio>

#include "common/canvas.h"
#include "foothold/base/error.h"
#include "foothold/io/image_file.h"
#include "foothold/io/recording_check.h"

namespace foothold::info {
namespace {

using apps::Canvas;

constexpr int kColumns = 6;
constexpr int kRows = 2;
constexpr int kTileWidth = 240;
constexpr int kTileHeight = 180;
constexpr int kCaption = 22;
constexpr int kGap = 8;
constexpr int kMapSide = 2 * (2 * kTileHeight + kCaption) + kGap;
constexpr double kTextHeight = 9.0;
constexpr Rgb8 kInk{40, 44, 52};
constexpr Rgb8 kEmpty{225, 225, 228};
constexpr Rgb8 kPath{30, 110, 180};
constexpr Rgb8 kStart{30, 150, 60};

/// The two axes along which the positions spread most, in which the path is drawn.
std::pair<int, int> widest_axes(const Eigen::Vector3f& extent) {
  int least = 0;
  extent.minCoeff(&least);
  return least == 0 ? std::pair{1, 2} : least == 1 ? std::pair{0, 2} : std::pair{0, 1};
}

std::string caption(const RgbdFrame& frame) {
  char text[96];
  std::snprintf(text, sizeof(text), "frame %d, %.2f s%s", static_cast<int>(frame.index), frame.timestamp_s,
                frame.world_from_camera.has_value() ? "" : ", no pose");
  return text;
}

void draw_frame(Canvas& canvas, const Recording& recording, int index, const cv::Point& corner) {
  const cv::Rect above(corner.x, corner.y + kCaption, kTileWidth, kTileHeight);
  const cv::Rect below(corner.x, corner.y + kCaption + kTileHeight, kTileWidth, kTileHeight);
  canvas.fill(above, kEmpty);
  canvas.fill(below, kEmpty);
  const cv::Point2d title(corner.x, corner.y + 0.5 * kCaption);
  try {
    const RgbdFrame frame = recording.load(index);
    canvas.text(title, Canvas::shortened(caption(frame), kTextHeight, kTileWidth), kTextHeight, kInk);
    canvas.picture(above, frame.colour);
    canvas.picture(below, colourise_depth(frame.depth, static_cast<float>(kLeastMedianDepth_m), static_cast<float>(kMostMedianDepth_m)));
  } catch (const FileError& error) {
    canvas.text(title, Canvas::shortened("frame " + std::to_string(index) + ": " + error.what(), kTextHeight, kTileWidth), kTextHeight,
                kInk);
  }
}

void draw_path(Canvas& canvas, const std::vector<std::optional<SE3>>& poses, const cv::Rect& area) {
  canvas.fill(area, kEmpty);
  Eigen::Vector3f low = Eigen::Vector3f::Constant(std::numeric_limits<float>::max());
  Eigen::Vector3f high = -low;
  for (const auto& pose : poses) {
    if (!pose.has_value()) continue;
    low = low.cwiseMin(pose->translation);
    high = high.cwiseMax(pose->translation);
  }
  if (!(low.x() <= high.x())) {
    canvas.text({area.x + 12.0, area.y + 20.0}, "no poses", kTextHeight, kInk);
    return;
  }
  const auto [across, down] = widest_axes(high - low);
  constexpr double kMargin = 40.0;
  const double span = std::max({static_cast<double>(high[across] - low[across]), static_cast<double>(high[down] - low[down]), 0.1});
  const double px_per_m = (area.width - 2.0 * kMargin) / span;
  const auto place = [&](const SE3& pose) {
    return cv::Point2d(area.x + kMargin + px_per_m * static_cast<double>(pose.translation[across] - low[across]),
                       area.y + kMargin + px_per_m * static_cast<double>(pose.translation[down] - low[down]));
  };
  std::vector<cv::Point2d> stretch;
  const SE3* first = nullptr;
  for (const auto& pose : poses) {
    if (pose.has_value()) {
      if (first == nullptr) first = &*pose;
      stretch.push_back(place(*pose));
      continue;
    }
    if (stretch.size() > 1) canvas.polyline(stretch, kPath, 2.0);
    stretch.clear();
  }
  if (stretch.size() > 1) canvas.polyline(stretch, kPath, 2.0);
  canvas.disc(place(*first), 6.0, kStart);
  char text[96];
  std::snprintf(text, sizeof(text), "positions: %c to the right, %c downwards; the long side is %.2f m", "xyz"[across], "xyz"[down], span);
  canvas.text({area.x + 12.0, area.y + 20.0}, text, kTextHeight, kInk);
}

}  // namespace

Image<Rgb8> contact_sheet(const Recording& recording) {
  constexpr int kWidth = kColumns * (kTileWidth + kGap) + kGap + kMapSide + kGap;
  constexpr int kHeight = kMapSide + 2 * kGap;
  Canvas canvas(kWidth, kHeight);
  const int num_tiles = std::min(kColumns * kRows, recording.num_frames());
  for (int tile = 0; tile < num_tiles; ++tile) {
    const int index =
        num_tiles == 1 ? 0 : static_cast<int>(static_cast<std::int64_t>(tile) * (recording.num_frames() - 1) / (num_tiles - 1));
    const cv::Point corner(kGap + tile % kColumns * (kTileWidth + kGap), kGap + tile / kColumns * (2 * kTileHeight + kCaption + kGap));
    draw_frame(canvas, recording, index, corner);
  }
  draw_path(canvas, recording.facts().world_from_camera, {kWidth - kMapSide - kGap, kGap, kMapSide, kMapSide});
  return canvas.image();
}

}  // namespace foothold::info

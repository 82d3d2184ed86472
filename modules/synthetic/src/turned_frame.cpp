// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "foothold/synthetic/turned_frame.h"

#include <utility>

#include "foothold/synthetic/room_changes.h"

namespace foothold {
namespace {

/// Clockwise by a quarter.
template <class Pixel>
Image<Pixel> turned_image(const Image<Pixel>& image) {
  Image<Pixel> turned(image.height(), image.width());
  for (int v = 0; v < image.height(); ++v) {
    for (int u = 0; u < image.width(); ++u) turned(image.height() - 1 - v, u) = image(u, v);
  }
  return turned;
}

template <class Pixel>
Image<Pixel> mirrored_image(const Image<Pixel>& image) {
  Image<Pixel> mirrored(image.width(), image.height());
  for (int v = 0; v < image.height(); ++v) {
    for (int u = 0; u < image.width(); ++u) mirrored(image.width() - 1 - u, v) = image(u, v);
  }
  return mirrored;
}

Intrinsics turned_intrinsics(const Intrinsics& camera, int height) {
  return {camera.fy, camera.fx, static_cast<float>(height - 1) - camera.cy, camera.cx};
}

/// What was right is below, what was below is left.
SE3 turned_from_camera() {
  SE3 result;
  result.rotation << 0.0F, -1.0F, 0.0F, 1.0F, 0.0F, 0.0F, 0.0F, 0.0F, 1.0F;
  return result;
}

RgbdFrame turned_once(const RgbdFrame& frame) {
  RgbdFrame turned = frame;
  turned.depth = turned_image(frame.depth);
  turned.colour = turned_image(frame.colour);
  turned.calibration.depth = turned_intrinsics(frame.calibration.depth, frame.depth.height());
  turned.calibration.colour = turned_intrinsics(frame.calibration.colour, frame.colour.height());
  turned.calibration.depth_from_colour = turned_from_camera() * frame.calibration.depth_from_colour * turned_from_camera().inverse();
  if (frame.world_from_camera.has_value()) turned.world_from_camera = *frame.world_from_camera * turned_from_camera().inverse();
  return turned;
}

}  // namespace

RgbdFrame turned_frame(const RgbdFrame& frame, int num_quarters) {
  RgbdFrame turned = frame;
  for (int i = 0; i < num_quarters % 4; ++i) turned = turned_once(turned);
  return turned;
}

RgbdFrame mirrored_frame(const RgbdFrame& frame) {
  RgbdFrame mirrored = frame;
  mirrored.depth = mirrored_image(frame.depth);
  mirrored.colour = mirrored_image(frame.colour);
  mirrored.calibration.depth.cx = static_cast<float>(frame.depth.width() - 1) - frame.calibration.depth.cx;
  mirrored.calibration.colour.cx = static_cast<float>(frame.colour.width() - 1) - frame.calibration.colour.cx;
  mirrored.calibration.depth_from_colour = mirrored_pose(frame.calibration.depth_from_colour);
  if (frame.world_from_camera.has_value()) mirrored.world_from_camera = mirrored_pose(*frame.world_from_camera);
  return mirrored;
}

}  // namespace foothold

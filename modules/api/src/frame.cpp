// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "foothold/api/frame.h"

#include "foothold/base/settings.h"

namespace foothold {
namespace {
std::string size_text(int width, int height) { return std::to_string(width) + "x" + std::to_string(height); }

std::string describe_intrinsics_error(const char* camera, const Intrinsics& k) {
  if (is_valid(k)) return {};
  const auto text = [](float value) { return detail::to_text(value); };
  return std::string("the ") + camera + " intrinsics are fx = " + text(k.fx) + ", fy = " + text(k.fy) + ", cx = " + text(k.cx) +
         ", cy = " + text(k.cy) + "; expected positive focal lengths and finite values" +
         (k.fy < 0.0F ? " (fy < 0 means that v points up: flip the rows)" : "");
}
}  // namespace

bool same_calibration(const RgbdCalibration& a, const RgbdCalibration& b) {
  const auto same = [](const Intrinsics& p, const Intrinsics& q) { return p.fx == q.fx && p.fy == q.fy && p.cx == q.cx && p.cy == q.cy; };
  return same(a.depth, b.depth) && same(a.colour, b.colour) && a.depth_from_colour.rotation == b.depth_from_colour.rotation &&
         a.depth_from_colour.translation == b.depth_from_colour.translation;
}

std::string describe_frame_error(const Frame& frame) {
  if (frame.depth.empty()) return "the depth image is empty";
  if (frame.colour.empty()) return "the colour image is empty";
  if (frame.depth.width != frame.colour.width || frame.depth.height != frame.colour.height) {
    return "the depth image is " + size_text(frame.depth.width, frame.depth.height) + " but the colour image is " +
           size_text(frame.colour.width, frame.colour.height) + "; both must have one size";
  }
  if (frame.depth.memory != frame.colour.memory) return "depth and colour live in different kinds of memory";
  if (frame.colour.bytes_per_pixel != 3 && frame.colour.bytes_per_pixel != 4) {
    return "the colour image has " + std::to_string(frame.colour.bytes_per_pixel) + " bytes per pixel; expected 3 or 4";
  }
  if (std::string error = describe_intrinsics_error("depth", frame.calibration.depth); !error.empty()) return error;
  if (std::string error = describe_intrinsics_error("colour", frame.calibration.colour); !error.empty()) return error;
  return describe_pose_error(frame.calibration.depth_from_colour, "depth_from_colour");
}

}  // namespace foothold

// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// Calibration files: what is accepted projects.
#include <cmath>

#include "camera_model.h"
#include "fuzz.h"
#include "text_file.h"

FOOTHOLD_FUZZ_TARGET(camera) {
  using namespace foothold;
  const std::string text = io::plain_text(fuzz::text_of(data, size));
  for (const io::CameraKind kind : {io::CameraKind::kDepth, io::CameraKind::kColour}) {
    fuzz::attempt([&] {
      io::CameraFile content = io::parse_camera(text, "camera.txt", kind);
      fuzz::require(is_valid(content.camera.intrinsics));
      for (const double k : content.camera.distortion.coefficients) fuzz::require(std::isfinite(k));
      if (content.depth_units_per_m.has_value())
        fuzz::require(*content.depth_units_per_m > 0.0 && std::isfinite(*content.depth_units_per_m));
      const io::ImageSize vga{640, 480};
      if (content.camera.size.empty()) content.camera.size = vga;
      fuzz::require(is_valid(resized(content.camera, vga).intrinsics));
      fuzz::require(!to_string(content.camera.distortion).empty());
      io::describe_impossible(content.camera.intrinsics, vga);
    });
  }
  return 0;
}

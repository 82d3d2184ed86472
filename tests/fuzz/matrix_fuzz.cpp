// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// Poses and camera matrices: what is accepted is rigid, and projects.
#include "calibration_file.h"
#include "fuzz.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace foothold;
  const std::string text = fuzz::text_of(data, size);
  fuzz::attempt([&] { fuzz::require(is_rigid(io::parse_transform(text, "pose.txt"), 1e-5F)); });
  fuzz::attempt([&] { fuzz::require(is_valid(io::parse_intrinsics(text, "camera.txt"))); });
  return 0;
}

// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// Looks for calibration files where people put them.
#pragma once

#include <filesystem>
#include <optional>

#include "camera_model.h"

namespace foothold::io {

struct FoundCamera {
  std::filesystem::path file;
  CameraFile content;
};

/// Looks in a recording's folder, its subfolders intrinsic, intrinsics, calibration, calib and camera, and then likewise one level up, for
/// .txt, .json, .csv and .yaml files whose names say that they hold intrinsics: "camera-intrinsics", "intrinsic_depth", "calib", "K", ...
/// Those that name the other camera are left out; without `strictly`, they come last.
/// @throws FileError if the file found is damaged. Files of ambiguous names, such as info.txt, are passed over if they hold no camera.
std::optional<FoundCamera> find_camera(const std::filesystem::path& folder, CameraKind kind, bool strictly);

}  // namespace foothold::io

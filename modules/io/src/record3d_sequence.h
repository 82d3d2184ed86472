// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// Exports of Record3D, an app for phones with LiDAR, as EXR and JPEG images.
#pragma once

#include "found_recording.h"

namespace foothold::io {

/// True for a folder with metadata.json and EXR_RGBD/depth/0.exr or depth/0.exr, and for the EXR_RGBD itself.
bool looks_like_record3d(const std::filesystem::path& folder);

/// Reads it. Depth is in metres, smaller than colour and registered to it; one camera stands for all frames. @throws FileError
FoundRecording read_record3d(const std::filesystem::path& folder, const Context& context);

/// Why Record3D's own archive is not read, be it a file or unpacked; empty if this is none.
std::string describe_record3d_archive(const std::filesystem::path& path);

}  // namespace foothold::io

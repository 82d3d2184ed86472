// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// Replica [Straub2019] as rendered for NICE-SLAM [Zhu2022].
#pragma once

#include "found_recording.h"

namespace foothold::io {

/// True for a folder with results/frame000000.jpg, results/depth000000.png.
bool looks_like_replica(const std::filesystem::path& folder);

/// Reads it, with poses from traj.txt. Depth counts 1/6553.5 m, unless cam_params.json tells otherwise. @throws FileError
FoundRecording read_replica(const std::filesystem::path& folder, const Context& context);

}  // namespace foothold::io

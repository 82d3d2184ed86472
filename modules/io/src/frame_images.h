// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// What all recordings on disk have in common.
#pragma once

#include <filesystem>

#include "foothold/api/frame.h"
#include "foothold/io/sequence.h"

namespace foothold::io {

/// Reads the two images of a frame, and registers them if asked to. 0 and 65535 in the depth image become 0.
/// @param depth_units_per_m  what the depth image counts, such as 1000 for millimetres.
/// @param frame  receives the images; its calibration must be set.
/// @throws FileError if one cannot be read or their sizes differ.
void read_frame_images(const std::filesystem::path& colour_file, const std::filesystem::path& depth_file, float depth_units_per_m,
                       const SequenceOptions& options, RgbdFrame& frame);

/// What to call the recording in a folder: the folder's own name, preceded by its parent's for the "seq-01" of 7-Scenes.
std::string recording_name(const std::filesystem::path& folder);

}  // namespace foothold::io

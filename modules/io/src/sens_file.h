// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// ScanNet's and BundleFusion's .sens files [Dai2017]: a whole recording in one.
#pragma once

#include <istream>

#include "found_recording.h"

namespace foothold::io {

/// What stands before and between the images of a .sens file.
struct SensContents {
  CameraModel depth;
  CameraModel colour;
  SE3 depth_from_colour;
  ImageSize depth_size;
  ImageSize colour_size;
  double depth_units_per_m = 0.0;
  std::vector<RecordedFrame> frames;
  std::string cut_short;  ///< of a file that ends before its last frame: where, and how many frames are left
};

/// Walks through a file of version 4 without reading its images. @throws FileError if it is damaged, coded in another way, or lacks half of
/// its frames.
SensContents parse_sens(std::istream& stream, const std::filesystem::path& file);

/// True if a folder holds exactly one .sens file.
bool has_sens_file(const std::filesystem::path& folder);
/// Reads that file. @throws FileError
FoundRecording read_sens_folder(const std::filesystem::path& folder, const Context& context);
/// Reads a .sens file. @throws FileError
FoundRecording read_sens_file(const std::filesystem::path& file, const Context& context);

}  // namespace foothold::io

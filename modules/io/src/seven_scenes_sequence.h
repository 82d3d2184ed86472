// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// A recording in the layout of 7-Scenes [Shotton2013].
#pragma once

#include <filesystem>
#include <string_view>
#include <vector>

#include "found_recording.h"

namespace foothold::io {

/// True if a folder holds files of this layout, whole or not.
bool looks_like_seven_scenes(const std::filesystem::path& folder);

/// Parses timestamps.txt: a line "index ... time [s]" for each frame, in order. @throws FileError
std::vector<double> parse_timestamps(std::string_view text, std::size_t num_frames, const std::filesystem::path& file);

/// Parses TrainSplit.txt or TestSplit.txt: lines of "sequenceN". @return "seq-NN" for each. @throws FileError
std::vector<std::string> parse_split(std::string_view text, const std::filesystem::path& file);

/// Reads a folder of frame-NNNNNN.{color.png|color.jpg,depth.png|depth.pgm,pose.txt}, numbered from 0 without gaps. Without timestamps.txt,
/// frames are 1/30 s apart. @throws FileError naming the first image that is missing.
FoundRecording read_seven_scenes(const std::filesystem::path& folder, const Context& context);

}  // namespace foothold::io

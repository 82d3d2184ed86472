// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// Opens recordings by name: folders on disk and rooms rendered on the fly.
#pragma once

#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "foothold/api/frame_source.h"
#include "foothold/base/context.h"

namespace foothold {

/// How a recording is read.
struct SequenceOptions {
  /// Warps colour into the depth camera's view where the two are not registered, as register_colour() does; the calibration then says so.
  /// Relocalisers want it so. False for the images as they were recorded.
  bool register_colour = true;
  /// Leaves out the frames of a TUM recording for which the ground truth is silent, and logs how many. Otherwise they come without a pose.
  bool only_with_pose = true;
};

/// A half-open range of frames.
struct FrameRange {
  static constexpr int kToTheEnd = std::numeric_limits<int>::max();
  int begin = 0;
  int end = kToTheEnd;
};

/// Parses "A:B", "A:", ":B" or ":". @throws InvalidSettings if the text is anything else, or A > B.
FrameRange parse_frame_range(const std::string& text);

/// Opens a recording.
///
/// @param spec  One of
///   - a 7-Scenes sequence folder (frame-000000.color.png or .jpg, .depth.png, .pose.txt; see docs/sequences.md for its calibration files),
///   - a TUM RGB-D folder (rgb.txt, depth.txt, groundtruth.txt) or an ICL-NUIM folder (associations.txt, *.gt.freiburg),
///   - "synthetic:NAME?key=value&..." for a rendered room,
///   each followed, if wanted, by "@A:B" for a part of it. Frames of a part keep their index in the whole.
/// @param context  Receives warnings in its log.
/// @throws FileError naming the file that is missing, damaged or surplus; InvalidSettings for a range outside the recording.
std::shared_ptr<Sequence> open_sequence(const std::string& spec, const Context& context, const SequenceOptions& options = {});

/// Reads which sequences of a 7-Scenes scene belong to the official split, from TrainSplit.txt or TestSplit.txt.
/// @param split  "train" or "test".
/// @return The sequence folders, ready for open_sequence().
/// @throws FileError if the folder is not that of a scene, or a listed sequence is missing; InvalidSettings for another split.
std::vector<std::string> read_split(const std::string& scene_folder, const std::string& split);

}  // namespace foothold

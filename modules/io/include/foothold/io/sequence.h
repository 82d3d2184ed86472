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
  /// Relocalisers want it so. False for the images as they were recorded; those of different size are registered all the same.
  bool register_colour = true;
  /// The depth camera, instead of what the recording's files say: "fx,fy,cx,cy", with 4, 5 or 8 coefficients of distortion behind if
  /// wanted, or the name of a file that holds them.
  std::string intrinsics;
  /// What depth images count, such as 1000 for millimetres, instead of what the recording's layout says; 0 for the latter. Below 1, it is
  /// metres per unit: 0.001 for millimetres.
  double depth_units_per_m = 0.0;
  /// How poses are to be understood, instead of what the recording's layout says: words separated by commas, such as "inverse,opengl".
  /// docs/sequences.md lists them. Empty for the latter.
  std::string pose_convention;
  /// Looks at a few frames whether unit of depth, intrinsics and poses can be right, and logs a warning if not.
  bool check = true;
};

/// A half-open range of frames.
struct FrameRange {
  static constexpr int kToTheEnd = std::numeric_limits<int>::max();  ///< the end of a range that goes to the last frame
  int begin = 0;                                                     ///< the first frame
  int end = kToTheEnd;                                               ///< behind the last frame
};

/// Parses "A:B", "A:", ":B" or ":". @throws InvalidSettings if the text is anything else, or A > B.
FrameRange parse_frame_range(const std::string& text);

/// Opens a recording.
///
/// @param spec  One of
///   - the folder of a recording in one of the layouts that docs/sequences.md lists: 7-Scenes, TUM RGB-D, ICL-NUIM, ...,
///   - "synthetic:NAME?key=value&..." for a rendered room,
///   each followed, if wanted, by "@A:B" for a part of it. Frames of a part keep their index in the whole.
/// @param context  Its log is told which intrinsics and unit of depth are used and where they come from, and warned of what looks wrong;
///                 when frames are loaded, too, by the thread that loads.
/// @return Frames for which the files have no pose, or one that is not finite, come without one. Frames of which an image is missing or
/// damaged come without depth, as long as they are fewer than half and the first is whole.
/// @throws FileError naming the file that is missing, damaged or surplus; InvalidSettings for a range outside the recording.
std::shared_ptr<Sequence> open_sequence(const std::string& spec, const Context& context, const SequenceOptions& options = {});

/// Reads which sequences of a 7-Scenes scene belong to the official split, from TrainSplit.txt or TestSplit.txt.
/// @param split  "train" or "test".
/// @return The sequence folders, ready for open_sequence().
/// @throws FileError if the folder is not that of a scene, or a listed sequence is missing; InvalidSettings for another split.
std::vector<std::string> read_split(const std::string& scene_folder, const std::string& split);

}  // namespace foothold

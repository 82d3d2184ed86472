// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// Recordings with depth and colour in folders of their own, numbered: ScanNet's export [Dai2017], Redwood [Choi2015], Open3D's recorder.
#pragma once

#include "found_recording.h"

namespace foothold::io {

/// Frames whose images have numbers.
struct NumberedFrames {
  std::vector<RecordedFrame> frames;
  std::vector<long> numbers;  ///< of the frames, rising
  long first_number = 0;      ///< of all images, those without a partner included
};

/// Pairs images by number. Images without a partner are left out and counted in the log. @throws FileError if no pair is left.
NumberedFrames pair_by_number(const std::map<long, std::filesystem::path>& depth, const std::map<long, std::filesystem::path>& colour,
                              const std::filesystem::path& folder, const Context& context);

/// Gives frames the poses of a list: in their order where there is one for each, else by number, so that none moves up where an image is
/// missing. @throws FileError
void add_pose_list(const std::filesystem::path& file, NumberedFrames& numbered);

/// True if a folder holds a folder of depth images and one of colour images.
bool has_numbered_folders(const std::filesystem::path& folder);

/// Poses come from pose/0.txt, ..., or from a list, camera.log, trajectory.log, traj.txt, poses.txt or the folder's only .log file.
/// @throws FileError
FoundRecording read_numbered_folders(const std::filesystem::path& folder, const Context& context);

}  // namespace foothold::io

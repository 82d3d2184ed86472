// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// Recordings in the layouts of the TUM RGB-D benchmark [Sturm2012] and of ICL-NUIM [Handa2014].
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "found_recording.h"

namespace foothold::io {

/// An image of a list, and when it was taken.
struct StampedFile {
  double timestamp_s = 0.0;
  std::string name;  ///< relative to the recording's folder
};

/// Two images taken at nearly the same time.
struct ImagePair {
  StampedFile depth;
  StampedFile colour;
};

/// Parses lines of "timestamp filename". @return By rising time; of equal lines next to each other, the first. @throws FileError
std::vector<StampedFile> parse_image_list(std::string_view text, const std::filesystem::path& file);

/// Parses lines of "timestamp depth-image timestamp colour-image", or the other way round, told apart by the folder's name. @throws
/// FileError
std::vector<ImagePair> parse_associations(std::string_view text, const std::filesystem::path& file);

/// Pairs images so that no pair is further apart than `max_difference_s`; nearest pairs first, each image once. @return By depth time.
std::vector<ImagePair> associate(const std::vector<StampedFile>& depth, const std::vector<StampedFile>& colour, double max_difference_s);

/// The two images nearest in time. @pre Neither list is empty. @return Their places in the lists.
std::pair<std::size_t, std::size_t> nearest_pair(const std::vector<StampedFile>& depth, const std::vector<StampedFile>& colour);

/// A time to the microsecond, for messages.
std::string time_text(double time_s);

/// True if a folder holds a list of colour or depth images, or associations.txt.
bool looks_like_tum(const std::filesystem::path& folder);

/// Reads a TUM or ICL-NUIM folder, or one of Bonn's or OpenLORIS. Frames for which the ground truth is silent come without a pose.
/// @throws FileError
FoundRecording read_tum(const std::filesystem::path& folder, const Context& context);

}  // namespace foothold::io

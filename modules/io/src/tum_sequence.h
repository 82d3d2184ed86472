// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// Recordings in the layouts of the TUM RGB-D benchmark [Sturm2012] and of ICL-NUIM [Handa2014].
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "foothold/base/context.h"
#include "foothold/io/sequence.h"

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

/// Parses lines of "timestamp filename". @return By rising time. @throws FileError
std::vector<StampedFile> parse_image_list(std::string_view text, const std::filesystem::path& file);

/// Parses lines of "timestamp depth-image timestamp colour-image", or the other way round, told apart by the folder's name. @throws
/// FileError
std::vector<ImagePair> parse_associations(std::string_view text, const std::filesystem::path& file);

/// Pairs images so that no pair is further apart than `max_difference_s`; nearest pairs first, each image once. @return By depth time.
std::vector<ImagePair> associate(const std::vector<StampedFile>& depth, const std::vector<StampedFile>& colour, double max_difference_s);

/// True if a folder holds rgb.txt, depth.txt or associations.txt.
bool looks_like_tum(const std::filesystem::path& folder);

/// Opens a TUM or ICL-NUIM folder. @throws FileError
std::unique_ptr<Sequence> open_tum(const std::filesystem::path& folder, const Context& context, const SequenceOptions& options);

}  // namespace foothold::io

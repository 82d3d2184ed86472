// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// What the readers of layouts hand over, and what they share.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "calibration_file.h"
#include "foothold/base/context.h"
#include "foothold/io/sequence.h"
#include "recorded_pose.h"

namespace foothold::io {

/// How the bytes of an image are to be understood.
enum class ImageCoding {
  kFile,     ///< PNG, JPEG, PGM
  kRaw,      ///< little-endian 16-bit numbers, or bytes of RGB
  kZlibRaw,  ///< the same, deflated
  kExr,      ///< depth as floating-point numbers, in a file of its own
};

/// Where the bytes of an image are.
struct StoredImage {
  std::filesystem::path file;
  std::uint64_t offset = 0;     ///< of the first byte
  std::uint64_t num_bytes = 0;  ///< 0 for the whole file
  ImageCoding coding = ImageCoding::kFile;
};

struct RecordedFrame {
  StoredImage depth;
  StoredImage colour;
  double timestamp_s = 0.0;
  std::optional<RecordedPose> pose;  ///< in the recording's own convention
};

/// Everything about a recording but its pixels.
struct FoundRecording {
  std::string layout;
  std::filesystem::path folder;
  std::vector<RecordedFrame> frames;  ///< at least one
  bool tells_poses = false;           ///< it has files or lists of poses, even if tracking was lost in every frame
  double depth_units_per_m = 1000.0;
  std::string depth_unit_source;  ///< empty for the layout's own
  PoseConvention pose_convention;
  CalibrationHints calibration;
  /// Sizes of raw images, which do not tell them themselves.
  ImageSize raw_depth_size;
  ImageSize raw_colour_size;
};

/// A way to lay out a recording in a folder.
struct Layout {
  const char* name;
  const char* description;  ///< its files, for messages
  bool (*matches)(const std::filesystem::path& folder);
  FoundRecording (*read)(const std::filesystem::path& folder, const Context& context);
};

/// All layouts, in the order in which they are tried.
const std::vector<Layout>& layouts();

/// What to call the recording in a folder: the folder's own name, preceded by its parent's for the "seq-01" of 7-Scenes.
std::string recording_name(const std::filesystem::path& folder);

/// Frames 1/30 s apart, for recordings that do not tell their times.
inline constexpr double kDefaultFrameRate_hz = 30.0;

/// The bytes of an image. @throws FileError
std::string read_stored_image(const StoredImage& image);

}  // namespace foothold::io

// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "record3d_sequence.h"

#include <algorithm>
#include <cmath>

#include "exr_image.h"
#include "numbered_files.h"
#include "numbered_folders.h"
#include "record3d_metadata.h"
#include "text_file.h"

namespace foothold::io {
namespace {

namespace fs = std::filesystem;

constexpr const char* kMetadata = "metadata.json";
constexpr const char* kExport = "EXR_RGBD";

/// The folder with depth/ and rgb/.
fs::path image_folder(const fs::path& folder) { return fs::is_directory(folder / kExport / "depth") ? folder / kExport : folder; }

/// metadata.json beside the images or one level up; empty without one.
fs::path metadata_file(const fs::path& folder) {
  const fs::path whole = fs::absolute(folder).lexically_normal();
  const fs::path itself = whole.filename().empty() ? whole.parent_path() : whole;
  for (const fs::path& place : {image_folder(folder), folder, itself.filename() == kExport ? itself.parent_path() : folder}) {
    if (fs::is_regular_file(place / kMetadata)) return place / kMetadata;
  }
  return {};
}

/// The selfie camera comes without poses: all of its frames have the identity.
void drop_identities(std::vector<std::optional<RecordedPose>>& poses, const fs::path& file, const Context& context) {
  const auto tells_nothing = [](const std::optional<RecordedPose>& pose) { return pose.has_value() && is_identity(*pose); };
  if (poses.size() < 2 || !std::all_of(poses.begin(), poses.end(), tells_nothing)) return;
  context.log(LogLevel::kWarning, file.string() + ": all " + std::to_string(poses.size()) +
                                      " poses are the identity, as those of the phone's front camera: they count as none");
  poses.clear();
}

void warn_of_variation(const Record3dMetadata& metadata, const fs::path& file, const Context& context) {
  constexpr float kMost = 0.02F;  // of the longer side: 1 degree, or 3 cm in 2 m
  if (metadata.variation <= kMost) return;
  context.log(LogLevel::kWarning, file.string() + ": the intrinsics differ between frames by up to " +
                                      std::to_string(std::lround(100.0F * metadata.variation)) +
                                      " % of the images' longer side; their median is used for all");
}

void add_metadata(const Record3dMetadata& metadata, const NumberedFrames& numbered, FoundRecording& found) {
  const long num_poses = static_cast<long>(metadata.poses.size());
  const bool from_one = numbered.first_number == 1 && numbered.numbers.back() == num_poses;
  const double rate_hz = metadata.frame_rate_hz > 0.0 ? metadata.frame_rate_hz : kDefaultFrameRate_hz;
  const bool has_times = static_cast<long>(metadata.times_s.size()) > numbered.numbers.back() - (from_one ? 1 : 0);
  for (std::size_t i = 0; i < found.frames.size(); ++i) {
    const long number = numbered.numbers[i] - (from_one ? 1 : 0);
    const auto place = static_cast<std::size_t>(number);
    if (number < num_poses) found.frames[i].pose = metadata.poses[place];
    found.frames[i].timestamp_s = has_times ? metadata.times_s[place] : static_cast<double>(number) / rate_hz;
  }
  found.tells_poses = num_poses > 0;
}

}  // namespace

bool looks_like_record3d(const fs::path& folder) {
  return !metadata_file(folder).empty() && !numbered_files(image_folder(folder) / "depth", "", {".exr"}).empty();
}

FoundRecording read_record3d(const fs::path& folder, const Context& context) {
  if (!reads_exr()) {
    throw FileError(folder.string() +
                    ": got depth in EXR images, which this build of Foothold does not read; expected OpenEXR (Debian's "
                    "libopenexr-dev) when it is configured");
  }
  FoundRecording found;
  found.folder = folder;
  found.layout = "Record3D";
  found.depth_units_per_m = 1.0;
  found.pose_convention.axes = PoseConvention::Axes::kOpenGl;
  const fs::path images = image_folder(folder);
  NumberedFrames numbered = pair_by_number(numbered_files(images / "depth", "", {".exr"}),
                                           numbered_files(images / "rgb", "", {".jpg", ".jpeg", ".png"}), images, context);
  found.frames = std::move(numbered.frames);
  for (RecordedFrame& frame : found.frames) frame.depth.coding = ImageCoding::kExr;
  const fs::path file = metadata_file(folder);
  Record3dMetadata metadata = parse_record3d_metadata(read_file(file, kMaxListFileBytes), file);
  drop_identities(metadata.poses, file, context);
  warn_of_variation(metadata, file, context);
  add_metadata(metadata, numbered, found);
  found.calibration.depth = metadata.camera;
  found.calibration.colour = metadata.camera;
  found.calibration.header = file.string() + (metadata.is_median ? ", the median of all frames" : "");
  return found;
}

std::string describe_record3d_archive(const fs::path& path) {
  const bool is_archive = fs::is_regular_file(path) && path.extension() == ".r3d";
  const bool is_unpacked = fs::is_directory(path / "rgbd") && fs::is_regular_file(path / "metadata");
  if (!is_archive && !is_unpacked) return {};
  return path.string() + ": got Record3D's own archive, whose depth is compressed by LZFSE and not read; expected its export as EXR + RGB";
}

}  // namespace foothold::io

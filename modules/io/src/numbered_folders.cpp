// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "numbered_folders.h"

#include <algorithm>
#include <charconv>
#include <limits>
#include <map>

#include "numbered_files.h"
#include "pose_lists.h"
#include "text_file.h"

namespace foothold::io {
namespace {

namespace fs = std::filesystem;

/// PrimeSense's camera as Open3D and Redwood assume it.
constexpr CameraModel kPrimeSense{{525.0F, 525.0F, 319.5F, 239.5F}, {}, {640, 480}};

fs::path depth_folder(const fs::path& folder) { return first_folder(folder, {"depth", "depths"}); }
fs::path colour_folder(const fs::path& folder) { return first_folder(folder, {"color", "colour", "rgb", "image", "images"}); }

/// Redwood's names hold a time in microseconds behind the number: 000001-000000033369.png.
std::optional<double> time_in_name(const fs::path& file) {
  const std::string stem = file.stem().string();
  const std::size_t dash = stem.find('-');
  double time_us = 0.0;
  if (dash == std::string::npos) return std::nullopt;
  const auto [end, error] = std::from_chars(stem.data() + dash + 1, stem.data() + stem.size(), time_us);
  if (error != std::errc() || end != stem.data() + stem.size()) return std::nullopt;
  return 1e-6 * time_us;
}

/// The file that lists all poses; empty without one.
fs::path find_pose_list(const fs::path& folder) {
  for (const char* name : {"camera.log", "trajectory.log", "traj.txt", "poses.txt", "trajectory.txt"}) {
    if (fs::is_regular_file(folder / name)) return folder / name;
  }
  std::vector<fs::path> logs;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
    if (entry.path().extension() == ".log") logs.push_back(entry.path());
  }
  return logs.size() == 1 ? logs.front() : fs::path();
}

/// The least step between numbers that rise; 1 for a single one.
long step_between(const std::vector<long>& numbers) {
  long step = std::numeric_limits<long>::max();
  for (std::size_t i = 1; i < numbers.size(); ++i) step = std::min(step, numbers[i] - numbers[i - 1]);
  return numbers.size() < 2 ? 1 : step;
}

/// Reads pose/N.txt of each frame that has one.
void add_pose_files(const fs::path& folder, NumberedFrames& numbered) {
  const std::map<long, fs::path> files = numbered_files(folder, "", {".txt"});
  for (std::size_t i = 0; i < numbered.frames.size(); ++i) {
    const auto file = files.find(numbered.numbers[i]);
    if (file != files.end()) numbered.frames[i].pose = parse_pose(read_text(file->second, kMaxNumbersFileBytes), file->second);
  }
}

/// ScanNet's extrinsics take each camera into a common frame.
std::optional<SE3> depth_from_colour(const fs::path& folder) {
  const fs::path depth = folder / "intrinsic" / "extrinsic_depth.txt";
  const fs::path colour = folder / "intrinsic" / "extrinsic_color.txt";
  if (!fs::exists(depth) || !fs::exists(colour)) return std::nullopt;
  return parse_transform(read_text(depth, kMaxNumbersFileBytes), depth).inverse() *
         parse_transform(read_text(colour, kMaxNumbersFileBytes), colour);
}

}  // namespace

NumberedFrames pair_by_number(const std::map<long, fs::path>& depth, const std::map<long, fs::path>& colour, const fs::path& folder,
                              const Context& context) {
  for (const auto& [images, kind] : {std::pair{&depth, "depth image, a PNG or PGM of 16 bits"}, {&colour, "colour image, a PNG or JPEG"}}) {
    if (images->empty())
      throw FileError(folder.string() + ": got no images of a kind that is read, expected at least one numbered " + kind);
  }
  NumberedFrames numbered;
  numbered.first_number = std::min(depth.begin()->first, colour.begin()->first);
  std::vector<RecordedFrame>& frames = numbered.frames;
  for (const auto& [number, depth_file] : depth) {
    const auto colour_file = colour.find(number);
    if (colour_file == colour.end()) continue;
    const double by_rate_s = static_cast<double>(number) / kDefaultFrameRate_hz;
    frames.push_back({{depth_file}, {colour_file->second}, time_in_name(depth_file).value_or(by_rate_s), std::nullopt});
    numbered.numbers.push_back(number);
  }
  if (frames.empty()) {
    throw FileError(folder.string() + ": got " + std::to_string(depth.size()) + " depth and " + std::to_string(colour.size()) +
                    " colour images, of which no two have the same number; expected pairs such as depth/0.png and color/0.jpg");
  }
  const std::size_t num_alone = depth.size() + colour.size() - 2 * frames.size();
  if (num_alone > 0) {
    context.log(LogLevel::kWarning, folder.string() + ": " + std::to_string(num_alone) +
                                        " images left out, of which there is none of the "
                                        "same number in the other folder");
  }
  return numbered;
}

void add_pose_list(const fs::path& file, NumberedFrames& numbered) {
  const std::map<long, std::optional<RecordedPose>> poses = parse_pose_list(read_text(file, kMaxListFileBytes), file);
  const bool one_each = poses.size() == numbered.frames.size();
  const bool one_a_number = static_cast<long>(poses.size()) > numbered.numbers.back() - numbered.first_number;
  const long step = one_a_number ? 1 : step_between(numbered.numbers);
  for (std::size_t i = 0; i < numbered.frames.size(); ++i) {
    const long place = one_each ? static_cast<long>(i) : (numbered.numbers[i] - numbered.first_number) / step;
    const auto pose = poses.find(place);
    if (pose != poses.end()) numbered.frames[i].pose = pose->second;
  }
}

bool has_numbered_folders(const fs::path& folder) { return !depth_folder(folder).empty() && !colour_folder(folder).empty(); }

FoundRecording read_numbered_folders(const fs::path& folder, const Context& context) {
  FoundRecording found;
  found.folder = folder;
  found.layout = fs::is_directory(folder / "intrinsic") ? "ScanNet's export" : "numbered images";
  NumberedFrames numbered = pair_by_number(numbered_files(depth_folder(folder), "", {".png", ".pgm"}),
                                           numbered_files(colour_folder(folder), "", {".png", ".jpg", ".jpeg"}), folder, context);
  const fs::path poses = first_folder(folder, {"pose", "poses"});
  const fs::path list = find_pose_list(folder);
  found.tells_poses = !poses.empty() || !list.empty();
  if (!poses.empty()) {
    add_pose_files(poses, numbered);
  } else if (!list.empty()) {
    add_pose_list(list, numbered);
  }
  found.frames = std::move(numbered.frames);
  found.calibration.depth_from_colour = depth_from_colour(folder);
  found.calibration.data_set = kPrimeSense;
  found.calibration.data_set_name = "Open3D's default";
  return found;
}

}  // namespace foothold::io

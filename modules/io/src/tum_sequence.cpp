// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "tum_sequence.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>

#include "lost_identities.h"
#include "text_file.h"
#include "time_unit.h"
#include "trajectory.h"

namespace foothold::io {
namespace {

namespace fs = std::filesystem;

/// Depth images count fifths of a millimetre, in most data sets of this layout.
constexpr double kDepthUnitsPerM = 5000.0;
/// OpenLORIS keeps the RealSense's millimetres.
constexpr double kOpenLorisDepthUnitsPerM = 1000.0;
/// Images further apart than this are not of one frame; half the time between frames and a little.
constexpr double kMaxPairDifference_s = 0.02;
/// Longest silence of the ground truth to interpolate over: ten samples of the motion capture system, three frames of a moving camera.
constexpr double kMaxPoseGap_s = 0.1;

constexpr ImageSize kVga{640, 480};
constexpr CameraModel kIclNuim{{481.20F, 480.0F, 319.5F, 239.5F}, {}, kVga};
constexpr CameraModel kRosDefault{{525.0F, 525.0F, 319.5F, 239.5F}, {}, kVga};

CameraModel bent(const Intrinsics& intrinsics, const std::array<double, 8>& coefficients) {
  return {intrinsics, {Distortion::Model::kBrownConrady, coefficients}, kVga};
}

/// The benchmark's three cameras, from its page on file formats; the third was undistorted before. [Sturm2012]
const std::array<CameraModel, 3>& freiburg() {
  static const std::array<CameraModel, 3> cameras{bent({517.3F, 516.5F, 318.6F, 255.3F}, {0.2624, -0.9531, -0.0054, 0.0026, 1.1633}),
                                                  bent({520.9F, 521.0F, 325.1F, 249.7F}, {0.2312, -0.7849, -0.0033, -0.0001, 0.9172}),
                                                  bent({535.4F, 539.2F, 320.1F, 247.6F}, {})};
  return cameras;
}

/// The camera of the Bonn RGB-D Dynamic Dataset, from its page [Palazzolo2019].
CameraModel bonn() { return bent({542.822841F, 542.576870F, 315.593520F, 237.756098F}, {0.039903, -0.099343, -0.000730, -0.000144, 0.0}); }

/// The camera that a folder's name tells, as in "rgbd_dataset_freiburg1_xyz" or "fr3_office".
CameraModel camera_by_name(const std::string& name) {
  if (name.find("bonn") != std::string::npos) return bonn();
  for (const std::string prefix : {"freiburg", "fr"}) {
    for (std::size_t at = name.find(prefix); at != std::string::npos; at = name.find(prefix, at + 1)) {
      const std::size_t digit = at + prefix.size();
      const bool number_ends = digit + 1 >= name.size() || std::isdigit(static_cast<unsigned char>(name[digit + 1])) == 0;
      if (digit < name.size() && name[digit] >= '1' && name[digit] <= '3' && number_ends) {
        return freiburg()[static_cast<std::size_t>(name[digit] - '1')];
      }
    }
  }
  return kRosDefault;
}

/// What a folder's files say.
struct TumFolder {
  fs::path path;
  fs::path ground_truth;  ///< empty without one
  bool is_icl_nuim = false;
};

TumFolder inspect(const fs::path& path) {
  TumFolder folder;
  folder.path = path;
  if (fs::exists(path / "groundtruth.txt")) folder.ground_truth = path / "groundtruth.txt";
  for (const fs::directory_entry& entry : fs::directory_iterator(path)) {
    const std::string name = entry.path().filename().string();
    constexpr std::string_view kSuffix = ".gt.freiburg";
    if (name.size() < kSuffix.size() || name.compare(name.size() - kSuffix.size(), kSuffix.size(), kSuffix) != 0) continue;
    if (folder.is_icl_nuim) throw FileError(path.string() + ": got several *.gt.freiburg files, expected one");
    folder.is_icl_nuim = true;
    folder.ground_truth = entry.path();
  }
  return folder;
}

/// The first of some lists that a folder holds; the last name where it holds none.
fs::path list_file(const fs::path& folder, std::initializer_list<const char*> names) {
  for (const char* name : names) {
    if (fs::exists(folder / name)) return folder / name;
  }
  return folder / *(names.end() - 1);
}

fs::path depth_list(const fs::path& folder) { return list_file(folder, {"aligned_depth.txt", "depth.txt"}); }
fs::path colour_list(const fs::path& folder) { return list_file(folder, {"colour.txt", "color.txt", "rgb.txt"}); }

void tell_unit(const fs::path& file, double s_per_unit, const Context& context) {
  if (s_per_unit != 1.0) context.log(LogLevel::kInfo, file.string() + ": its times are read as " + time_unit_name(s_per_unit));
}

/// A list of images, its times brought to seconds.
std::vector<StampedFile> read_list(const fs::path& file, const Context& context) {
  std::vector<StampedFile> images = parse_image_list(read_text(file, kMaxListFileBytes), file);
  std::vector<double> times;
  for (const StampedFile& image : images) times.push_back(image.timestamp_s);
  const double s_per_unit = seconds_per_unit(times);
  for (StampedFile& image : images) image.timestamp_s *= s_per_unit;
  tell_unit(file, s_per_unit, context);
  return images;
}

/// A list of pairs, its times brought to seconds; those of ICL-NUIM count frames, whatever lies between them.
std::vector<ImagePair> read_associations(const fs::path& file, bool counts_frames, const Context& context) {
  std::vector<ImagePair> pairs = parse_associations(read_text(file, kMaxListFileBytes), file);
  std::vector<double> times;
  for (const ImagePair& pair : pairs) times.push_back(pair.depth.timestamp_s);
  const double s_per_unit = counts_frames ? 1.0 : seconds_per_unit(times);
  for (ImagePair& pair : pairs) {
    pair.depth.timestamp_s *= s_per_unit;
    pair.colour.timestamp_s *= s_per_unit;
  }
  tell_unit(file, s_per_unit, context);
  return pairs;
}

[[noreturn]] void throw_no_pair(const fs::path& file, const std::vector<StampedFile>& depth, const std::vector<StampedFile>& colour) {
  const auto [d, c] = nearest_pair(depth, colour);
  throw_file_error(file,
                   "no time within 20 ms of one in the list of colour images: the nearest two are " + time_text(depth[d].timestamp_s) +
                       " and " + time_text(colour[c].timestamp_s),
                   "images of one recording, their times in seconds");
}

std::vector<ImagePair> read_pairs(const TumFolder& tum, const Context& context) {
  const fs::path& folder = tum.path;
  const fs::path depth_file = depth_list(folder);
  const fs::path colour_file = colour_list(folder);
  if (!fs::exists(colour_file) && !fs::exists(depth_file)) {
    return read_associations(folder / "associations.txt", tum.is_icl_nuim, context);
  }
  const std::vector<StampedFile> depth = read_list(depth_file, context);
  const std::vector<StampedFile> colour = read_list(colour_file, context);
  std::vector<ImagePair> pairs = associate(depth, colour, kMaxPairDifference_s);
  if (pairs.empty()) throw_no_pair(depth_file, depth, colour);
  if (pairs.size() < depth.size()) {
    context.log(LogLevel::kInfo, folder.string() + ": " + std::to_string(depth.size() - pairs.size()) + " of " +
                                     std::to_string(depth.size()) + " depth images left out: no colour image within 20 ms");
  }
  return pairs;
}

/// The ground truth, its times brought to those of the frames. Empty without any.
std::vector<TruePose> read_truth(const TumFolder& folder, double first_frame_s, double last_frame_s, const Context& context) {
  const fs::path& file = folder.ground_truth;
  if (file.empty()) return {};
  std::vector<TruePose> truth = parse_ground_truth(read_text(file, kMaxListFileBytes), file);
  std::vector<double> times;
  for (const TruePose& sample : truth) times.push_back(sample.timestamp_s);
  const double s_per_unit = folder.is_icl_nuim ? 1.0 : sample_unit(times, first_frame_s, last_frame_s, kMaxPoseGap_s);
  for (TruePose& sample : truth) sample.timestamp_s *= s_per_unit;
  tell_unit(file, s_per_unit, context);
  drop_lost_identities(truth, file.string(), context);
  return truth;
}

void add_poses(const TumFolder& folder, std::vector<RecordedFrame>& frames, const Context& context) {
  const double first_s = frames.front().timestamp_s;
  const double last_s = frames.back().timestamp_s;
  const std::vector<TruePose> truth = read_truth(folder, first_s, last_s, context);
  bool any = false;
  for (RecordedFrame& frame : frames) {
    frame.pose = interpolate(truth, frame.timestamp_s, kMaxPoseGap_s);
    any = any || frame.pose.has_value();
  }
  const bool all_lost = std::none_of(truth.begin(), truth.end(), [](const TruePose& sample) { return sample.pose.has_value(); });
  const bool overlaps = !truth.empty() && truth.front().timestamp_s <= last_s && truth.back().timestamp_s >= first_s;
  if (any || truth.empty() || (all_lost && overlaps)) return;
  throw_file_error(folder.ground_truth,
                   "no pose " + std::string(overlaps ? "within 0.1 s before and behind" : "at the time of") + " any frame: it tells of " +
                       time_text(truth.front().timestamp_s) + " to " + time_text(truth.back().timestamp_s) +
                       ", the frames were taken from " + time_text(first_s) + " to " + time_text(last_s),
                   "the ground truth of this recording, its times in seconds");
}

}  // namespace

bool looks_like_tum(const fs::path& folder) {
  return fs::exists(depth_list(folder)) || fs::exists(colour_list(folder)) || fs::exists(folder / "associations.txt");
}

FoundRecording read_tum(const fs::path& path, const Context& context) {
  const TumFolder folder = inspect(path);
  FoundRecording found;
  found.folder = path;
  found.layout = folder.is_icl_nuim ? "ICL-NUIM" : "TUM RGB-D";
  for (const ImagePair& pair : read_pairs(folder, context)) {
    found.frames.push_back({{path / pair.depth.name}, {path / pair.colour.name}, pair.depth.timestamp_s, std::nullopt});
  }
  add_poses(folder, found.frames, context);
  found.tells_poses = !folder.ground_truth.empty();
  if (folder.is_icl_nuim) {  // counts frames instead of seconds, and has y upwards in world and camera
    for (RecordedFrame& frame : found.frames) frame.timestamp_s /= kDefaultFrameRate_hz;
    found.pose_convention.mirror_y = true;
  }
  const bool is_openloris = depth_list(path).filename() == "aligned_depth.txt";
  found.depth_units_per_m = is_openloris ? kOpenLorisDepthUnitsPerM : kDepthUnitsPerM;
  found.calibration.data_set = folder.is_icl_nuim ? kIclNuim : camera_by_name(recording_name(path));
  found.calibration.data_set_name = folder.is_icl_nuim ? "ICL-NUIM's own" : "the TUM benchmark's, by the folder's name";
  return found;
}

}  // namespace foothold::io

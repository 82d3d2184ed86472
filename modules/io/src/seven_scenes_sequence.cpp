// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "seven_scenes_sequence.h"

#include <array>
#include <cctype>
#include <cstdio>
#include <map>

#include "text_file.h"
#include "time_unit.h"

namespace foothold::io {
namespace {

namespace fs = std::filesystem;

constexpr const char* kTimestampsFile = "timestamps.txt";  ///< what a recording ends with

/// Which files of a frame a folder holds.
struct FrameFiles {
  std::string depth_suffix;   ///< empty if there is no depth
  std::string colour_suffix;  ///< empty if there is no colour
  bool pose = false;
};

std::string frame_name(int index, const std::string& suffix) {
  std::array<char, 32> stem{};
  std::snprintf(stem.data(), stem.size(), "frame-%06d", index);
  return stem.data() + suffix;
}

/// Splits "frame-NNNNNN.suffix". @return false for any other name.
bool parse_frame_name(const std::string& name, int& index, std::string& suffix) {
  constexpr std::size_t kPrefix = 6;
  constexpr std::size_t kDigits = 6;
  if (name.size() <= kPrefix + kDigits || name.compare(0, kPrefix, "frame-") != 0 || name[kPrefix + kDigits] != '.') return false;
  index = 0;
  for (std::size_t i = kPrefix; i < kPrefix + kDigits; ++i) {
    if (std::isdigit(static_cast<unsigned char>(name[i])) == 0) return false;
    index = 10 * index + (name[i] - '0');
  }
  suffix = name.substr(kPrefix + kDigits);
  return true;
}

std::map<int, FrameFiles> list_frames(const fs::path& folder) {
  std::map<int, FrameFiles> frames;
  int index = 0;
  std::string suffix;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
    if (!parse_frame_name(entry.path().filename().string(), index, suffix)) continue;
    FrameFiles& files = frames[index];
    if (suffix == ".pose.txt") files.pose = true;
    // The lossless image wins where a folder has both.
    if (suffix == ".depth.png" || (suffix == ".depth.pgm" && files.depth_suffix.empty())) files.depth_suffix = suffix;
    if (suffix == ".color.png" || (suffix == ".color.jpg" && files.colour_suffix.empty())) files.colour_suffix = suffix;
  }
  return frames;
}

[[noreturn]] void throw_missing(const fs::path& folder, const std::string& name, const std::string& reason) {
  throw FileError((folder / name).string() + ": no such file, but " + reason);
}

/// The files of frames 0, 1, ..., of which those in the middle may be missing. The last frame of a recording that was not finished, as its
/// missing times tell, is left out if it lacks one: its recorder was killed while it wrote.
std::vector<FrameFiles> complete_frames(const fs::path& folder, const Context& context) {
  std::vector<FrameFiles> frames;
  const std::map<int, FrameFiles> found = list_frames(folder);
  const bool is_unfinished = !fs::exists(folder / kTimestampsFile);
  for (const auto& [index, files] : found) {
    const bool is_last = index == found.rbegin()->first && index > 0;
    if (is_unfinished && is_last && (files.depth_suffix.empty() || files.colour_suffix.empty())) {
      context.log(LogLevel::kWarning, folder.string() + ": frame " + std::to_string(index) + ", the last, lacks an image and is left out");
      break;
    }
    if (found.begin()->first != 0 || 2 * index >= 3 * static_cast<int>(found.size())) {
      throw_missing(folder, frame_name(static_cast<int>(frames.size()), ".depth.png"),
                    "frames are numbered from 0, and there are files of frame " + std::to_string(index));
    }
    frames.resize(static_cast<std::size_t>(index));
    frames.push_back(files);
  }
  for (FrameFiles& files : frames) {
    if (files.depth_suffix.empty()) files.depth_suffix = ".depth.png";
    if (files.colour_suffix.empty()) files.colour_suffix = ".color.png";
  }
  return frames;
}

/// Times of the frames [s]: from timestamps.txt, or 30 Hz.
std::vector<double> read_timestamps(const fs::path& folder, std::size_t num_frames, const Context& context) {
  const fs::path file = folder / kTimestampsFile;
  if (fs::exists(file)) {
    std::vector<double> times = parse_timestamps(read_text(file, kMaxListFileBytes), num_frames, file);
    const double s_per_unit = seconds_per_unit(times);
    if (s_per_unit != 1.0) context.log(LogLevel::kInfo, file.string() + ": read as " + time_unit_name(s_per_unit));
    for (double& time : times) time *= s_per_unit;
    return times;
  }
  std::vector<double> times_s;
  for (std::size_t i = 0; i < num_frames; ++i) times_s.push_back(static_cast<double>(i) / kDefaultFrameRate_hz);
  return times_s;
}

}  // namespace

bool looks_like_seven_scenes(const fs::path& folder) { return !list_frames(folder).empty(); }

std::vector<double> parse_timestamps(std::string_view text, std::size_t num_frames, const fs::path& file) {
  std::vector<double> times_s;
  for (const TextLine& line : split_lines(text)) {
    const std::string where = "line " + std::to_string(line.number);
    const double index = parse_number(line.words.front(), file, "the frame index in " + where);
    if (index != static_cast<double>(times_s.size()) || line.words.size() < 2) {
      throw_file_error(file, in_quotes(line.words.front()) + " and " + std::to_string(line.words.size() - 1) + " numbers in " + where,
                       "frame index " + std::to_string(times_s.size()) + " and its time [s]");
    }
    times_s.push_back(parse_number(line.words.back(), file, "the time in " + where));
  }
  if (times_s.size() != num_frames) {
    throw_file_error(file, std::to_string(times_s.size()) + " lines",
                     "one for each of the folder's " + std::to_string(num_frames) + " frames");
  }
  return times_s;
}

FoundRecording read_seven_scenes(const fs::path& folder, const Context& context) {
  const std::vector<FrameFiles> files = complete_frames(folder, context);
  const std::vector<double> times_s = read_timestamps(folder, files.size(), context);
  FoundRecording found;
  found.folder = folder;
  found.layout = "7-Scenes";
  for (std::size_t i = 0; i < files.size(); ++i) {
    const int index = static_cast<int>(i);
    RecordedFrame frame{
        {folder / frame_name(index, files[i].depth_suffix)}, {folder / frame_name(index, files[i].colour_suffix)}, times_s[i], {}};
    const fs::path pose_file = folder / frame_name(index, ".pose.txt");
    found.tells_poses = found.tells_poses || files[i].pose;
    if (files[i].pose) frame.pose = parse_pose(read_text(pose_file, kMaxNumbersFileBytes), pose_file);
    found.frames.push_back(std::move(frame));
  }
  found.calibration.data_set = CameraModel{{585.0F, 585.0F, 320.0F, 240.0F}, {}, {640, 480}};
  found.calibration.data_set_name = "7-Scenes' own";
  found.calibration.may_be_seven_scenes = true;
  return found;
}

}  // namespace foothold::io

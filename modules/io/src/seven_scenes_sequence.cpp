// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "seven_scenes_sequence.h"

#include <array>
#include <cctype>
#include <cstdio>
#include <map>

#include "calibration_file.h"
#include "foothold/base/contract.h"
#include "frame_images.h"
#include "text_file.h"

namespace foothold::io {
namespace {

namespace fs = std::filesystem;

/// Which files of a frame a folder holds.
struct FrameFiles {
  bool depth = false;
  bool pose = false;
  std::string colour_suffix;  ///< empty if there is no colour
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
    if (suffix == ".depth.png") frames[index].depth = true;
    if (suffix == ".pose.txt") frames[index].pose = true;
    // The lossless image wins where a folder has both.
    if (suffix == ".color.png" || (suffix == ".color.jpg" && frames[index].colour_suffix.empty())) frames[index].colour_suffix = suffix;
  }
  return frames;
}

[[noreturn]] void throw_missing(const fs::path& folder, const std::string& name, const std::string& reason) {
  throw FileError((folder / name).string() + ": no such file, but " + reason);
}

/// The files of frames 0, 1, ...; complains about the first one that is missing.
std::vector<FrameFiles> complete_frames(const fs::path& folder) {
  const std::map<int, FrameFiles> found = list_frames(folder);
  bool any_pose = false;
  for (const auto& [index, files] : found) any_pose = any_pose || files.pose;
  std::vector<FrameFiles> frames;
  for (const auto& [index, files] : found) {
    const int expected = static_cast<int>(frames.size());
    const std::string reason = "frames are numbered from 0 without gaps, and there are files of frame " + std::to_string(index);
    if (index != expected) throw_missing(folder, frame_name(expected, ".depth.png"), reason);
    const std::string other = "there are other files of frame " + std::to_string(index);
    if (!files.depth) throw_missing(folder, frame_name(index, ".depth.png"), other);
    if (files.colour_suffix.empty()) throw_missing(folder, frame_name(index, ".color.png") + " (or .color.jpg)", other);
    if (!files.pose && any_pose) throw_missing(folder, frame_name(index, ".pose.txt"), other + ", and other frames have poses");
    frames.push_back(files);
  }
  return frames;
}

/// Times of the frames [s]: from timestamps.txt, or 30 Hz.
std::vector<double> read_timestamps(const fs::path& folder, std::size_t num_frames) {
  constexpr double kFrameRate_hz = 30.0;
  const fs::path file = folder / "timestamps.txt";
  if (fs::exists(file)) return parse_timestamps(read_file(file, kMaxListFileBytes), num_frames, file);
  std::vector<double> times_s;
  for (std::size_t i = 0; i < num_frames; ++i) times_s.push_back(static_cast<double>(i) / kFrameRate_hz);
  return times_s;
}

class SevenScenesSequence : public Sequence {
 public:
  SevenScenesSequence(const fs::path& folder, const SequenceOptions& options)
      : folder_(folder),
        options_(options),
        frames_(complete_frames(folder)),
        calibration_(read_seven_scenes_calibration(folder)),
        times_s_(read_timestamps(folder, frames_.size())) {}

  std::string name() const override { return recording_name(folder_); }
  int num_frames() const override { return static_cast<int>(frames_.size()); }

  RgbdFrame load(int index) const override {
    FOOTHOLD_EXPECTS(index >= 0 && index < num_frames());
    constexpr float kMillimetres = 1000.0F;
    const FrameFiles& files = frames_[static_cast<std::size_t>(index)];
    RgbdFrame frame;
    frame.calibration = calibration_;
    frame.index = index;
    frame.timestamp_s = times_s_[static_cast<std::size_t>(index)];
    if (files.pose) {
      const fs::path pose_file = folder_ / frame_name(index, ".pose.txt");
      frame.world_from_camera = parse_transform(read_file(pose_file, kMaxNumbersFileBytes), pose_file);
    }
    read_frame_images(folder_ / frame_name(index, files.colour_suffix), folder_ / frame_name(index, ".depth.png"), kMillimetres, options_,
                      frame);
    return frame;
  }

 private:
  fs::path folder_;
  SequenceOptions options_;
  std::vector<FrameFiles> frames_;
  RgbdCalibration calibration_;
  std::vector<double> times_s_;
};

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

std::unique_ptr<Sequence> open_seven_scenes(const fs::path& folder, const SequenceOptions& options) {
  return std::make_unique<SevenScenesSequence>(folder, options);
}

}  // namespace foothold::io

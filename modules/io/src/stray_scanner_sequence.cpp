// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "stray_scanner_sequence.h"

#include <array>
#include <limits>

#include "numbered_files.h"
#include "numbered_folders.h"
#include "text_file.h"

namespace foothold::io {

namespace fs = std::filesystem;

bool looks_like_stray_scanner(const fs::path& folder) { return fs::exists(folder / "odometry.csv") && fs::is_directory(folder / "depth"); }

std::vector<OdometryRow> parse_odometry(std::string_view text, const fs::path& file) {
  constexpr std::size_t kNumColumns = 9;
  std::vector<OdometryRow> rows;
  for (const TextLine& line : split_lines(text)) {
    const std::string where = "line " + std::to_string(line.number);
    if (line.words.size() < kNumColumns) {
      throw_file_error(file, std::to_string(line.words.size()) + " columns in " + where, "timestamp, frame, x, y, z, qx, qy, qz, qw");
    }
    OdometryRow row;
    row.timestamp_s = parse_number(line.words[0], file, "the time in " + where);
    const double frame = parse_number(line.words[1], file, "the frame in " + where);
    if (!(frame >= 0.0 && frame <= 1e9)) throw_file_error(file, "frame " + in_quotes(line.words[1]) + " in " + where, "a frame number");
    row.frame = static_cast<long>(frame);
    std::array<double, 7> numbers{};
    for (std::size_t i = 0; i < numbers.size(); ++i) {
      const std::string_view word = line.words[2 + i];
      numbers[i] = is_not_finite(word) ? std::numeric_limits<double>::quiet_NaN() : parse_number(word, file, "a pose in " + where);
    }
    row.pose = pose_from_quaternion(numbers, file, where);
    rows.push_back(row);
  }
  return rows;
}

FoundRecording read_stray_scanner(const fs::path& folder, const Context& context) {
  if (!fs::is_directory(folder / "rgb") && fs::exists(folder / "rgb.mp4")) {
    throw FileError((folder / "rgb.mp4").string() +
                    ": got a video, expected its images in rgb/; unpack it with: mkdir rgb && ffmpeg -i "
                    "rgb.mp4 -start_number 0 -q:v 2 rgb/%06d.jpg");
  }
  FoundRecording found;
  found.folder = folder;
  found.layout = "Stray Scanner";
  found.tells_poses = true;
  NumberedFrames numbered =
      pair_by_number(numbered_files(folder / "depth", "", {".png"}), numbered_files(folder / "rgb", "", {".png", ".jpg"}), folder, context);
  found.frames = std::move(numbered.frames);
  const fs::path file = folder / "odometry.csv";
  const std::vector<OdometryRow> rows = parse_odometry(read_text(file, kMaxListFileBytes), file);
  std::map<long, const OdometryRow*> by_frame;
  for (const OdometryRow& row : rows) by_frame.emplace(row.frame, &row);
  for (std::size_t i = 0; i < found.frames.size(); ++i) {
    const auto row = by_frame.find(numbered.numbers[i]);
    if (row == by_frame.end()) continue;
    found.frames[i].pose = row->second->pose;
    found.frames[i].timestamp_s = row->second->timestamp_s;
  }
  return found;
}

}  // namespace foothold::io

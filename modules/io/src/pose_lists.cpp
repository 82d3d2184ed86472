// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "pose_lists.h"

#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "text_file.h"

namespace foothold::io {
namespace {

namespace fs = std::filesystem;

/// The numbers of a line, NaN for those that are not finite.
std::vector<double> numbers_of(const TextLine& line, const fs::path& file) {
  std::vector<double> numbers;
  for (const std::string_view word : line.words) {
    numbers.push_back(is_not_finite(word) ? std::numeric_limits<double>::quiet_NaN()
                                          : parse_number(word, file, "a number in line " + std::to_string(line.number)));
  }
  return numbers;
}

std::map<long, std::optional<RecordedPose>> parse_log(const std::vector<TextLine>& lines, const fs::path& file) {
  constexpr std::size_t kLinesPerPose = 5;
  std::map<long, std::optional<RecordedPose>> poses;
  for (std::size_t i = 0; i < lines.size(); i += kLinesPerPose) {
    const std::string where = " in line " + std::to_string(lines[i].number);
    const std::vector<double> head = numbers_of(lines[i], file);
    if (head.size() != 3 || !(head[0] >= 0.0 && head[0] <= 1e9)) throw_file_error(file, "no frame number" + where, "three whole numbers");
    std::vector<double> numbers;
    for (std::size_t row = 1; row < kLinesPerPose && i + row < lines.size(); ++row) {
      const std::vector<double> more = numbers_of(lines[i + row], file);
      if (more.size() != 4) break;
      numbers.insert(numbers.end(), more.begin(), more.end());
    }
    if (numbers.size() != 16) throw_file_error(file, "no four lines of four numbers behind that" + where, "a 4x4 pose");
    poses[static_cast<long>(head[0])] = pose_from_matrix(numbers, file);
  }
  return poses;
}

}  // namespace

std::map<long, std::optional<RecordedPose>> parse_pose_list(std::string_view text, const fs::path& file) {
  const std::vector<TextLine> lines = split_lines(text);
  if (lines.empty()) throw_file_error(file, "no pose", "lines of 12 or 16 numbers");
  if (lines.front().words.size() == 3) return parse_log(lines, file);
  std::map<long, std::optional<RecordedPose>> poses;
  for (const TextLine& line : lines) {
    if (line.words.size() != 12 && line.words.size() != 16) {
      throw_file_error(file, std::to_string(line.words.size()) + " numbers in line " + std::to_string(line.number),
                       "12 or 16 for a pose, or Redwood's log");
    }
    const long number = static_cast<long>(poses.size());
    poses[number] = pose_from_matrix(numbers_of(line, file), file);
  }
  return poses;
}

}  // namespace foothold::io

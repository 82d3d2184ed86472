// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "record3d_metadata.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <limits>

#include "text_file.h"

namespace foothold::io {
namespace {

namespace fs = std::filesystem;

using Rows = std::vector<std::vector<double>>;

/// Where the value under a name begins; npos if there is none.
std::size_t value_of(std::string_view text, std::string_view name) {
  constexpr std::string_view kBlanks = " \t\r\n";
  const std::string quoted = "\"" + std::string(name) + "\"";
  for (std::size_t at = text.find(quoted); at != std::string_view::npos; at = text.find(quoted, at + 1)) {
    const std::size_t colon = text.find_first_not_of(kBlanks, at + quoted.size());
    if (colon != std::string_view::npos && text[colon] == ':') return text.find_first_not_of(kBlanks, colon + 1);
  }
  return std::string_view::npos;
}

/// Reads a number, or a word that stands for none, and moves on. @return Empty if there is neither.
std::optional<double> take_number(std::string_view text, std::size_t& at) {
  for (const std::string_view word : {"null", "NaN", "Infinity", "-Infinity"}) {
    if (text.substr(at, word.size()) != word) continue;
    at += word.size();
    return std::numeric_limits<double>::quiet_NaN();
  }
  double number = 0.0;
  const auto [end, error] = std::from_chars(text.data() + at, text.data() + text.size(), number);
  if (error != std::errc()) return std::nullopt;
  at = static_cast<std::size_t>(end - text.data());
  return number;
}

/// Rows of exactly `count` numbers.
Rows rows_of(std::string_view text, std::string_view name, std::size_t count, const fs::path& file) {
  const Rows rows = json_rows(text, name, file);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (rows[i].size() == count) continue;
    throw_file_error(file, std::to_string(rows[i].size()) + " numbers in row " + std::to_string(i) + " of " + std::string(name),
                     std::to_string(count));
  }
  return rows;
}

/// A single number; 0 where it is missing or none.
double number_of(std::string_view text, std::string_view name, const fs::path& file) {
  const Rows rows = rows_of(text, name, 1, file);
  return rows.empty() || !std::isfinite(rows[0][0]) ? 0.0 : rows[0][0];
}

ImageSize told_size(std::string_view text, const fs::path& file) {
  const double width = number_of(text, "w", file);
  const double height = number_of(text, "h", file);
  const bool sane = width >= 1.0 && width <= 1e5 && height >= 1.0 && height <= 1e5;
  return sane ? ImageSize{static_cast<int>(width), static_cast<int>(height)} : ImageSize{};
}

/// fx fy cx cy of a 3x3 matrix, column by column, or row by row where others wrote it so.
std::array<double, 4> coefficients_of(const std::vector<double>& k) {
  const bool by_rows = k[6] == 0.0 && k[7] == 0.0 && (k[2] != 0.0 || k[5] != 0.0);
  return by_rows ? std::array<double, 4>{k[0], k[4], k[2], k[5]} : std::array<double, 4>{k[0], k[4], k[6], k[7]};
}

std::array<double, 4> median_of(const Rows& rows) {
  std::array<double, 4> median{};
  std::vector<double> column(rows.size());
  for (std::size_t i = 0; i < median.size(); ++i) {
    std::transform(rows.begin(), rows.end(), column.begin(), [&](const std::vector<double>& row) { return row[i]; });
    const auto middle = column.begin() + static_cast<std::ptrdiff_t>(column.size() / 2);
    std::nth_element(column.begin(), middle, column.end());
    median[i] = *middle;
  }
  return median;
}

double largest_difference(const Rows& rows, const std::array<double, 4>& median) {
  double largest = 0.0;
  for (const std::vector<double>& row : rows) {
    for (std::size_t i = 0; i < median.size(); ++i) largest = std::max(largest, std::abs(row[i] - median[i]));
  }
  return largest;
}

void read_camera(std::string_view text, const fs::path& file, Record3dMetadata& metadata) {
  Rows rows = rows_of(text, "perFrameIntrinsicCoeffs", 4, file);
  const auto has_none = [](const std::vector<double>& row) { return !std::isfinite(row[0] + row[1] + row[2] + row[3]); };
  rows.erase(std::remove_if(rows.begin(), rows.end(), has_none), rows.end());
  const Rows matrix = rows_of(text, "K", 9, file);
  if (rows.empty() && matrix.empty()) return;
  const std::array<double, 4> k = rows.empty() ? coefficients_of(matrix[0]) : median_of(rows);
  metadata.is_median = !rows.empty();
  const bool sane = std::isfinite(k[0] + k[1] + k[2] + k[3]);
  if (!sane) throw_file_error(file, "the matrix K of " + numbers_text(matrix[0].data(), 9), "fx 0 0  0 fy 0  cx cy 1");
  metadata.camera = CameraModel{parse_camera(numbers_text(k.data(), k.size()), file).camera.intrinsics, {}, told_size(text, file)};
  const ImageSize& size = metadata.camera->size;
  if (!size.empty()) metadata.variation = static_cast<float>(largest_difference(rows, k) / std::max(size.width, size.height));
}

}  // namespace

Rows json_rows(std::string_view text, std::string_view name, const fs::path& file) {
  Rows rows;
  int depth = 0;
  bool begins_row = true;
  for (std::size_t at = value_of(text, name); at < text.size();) {
    const char c = text[at];
    if (depth == 0 && text.substr(at, 4) == "null") return rows;
    if (c == '[' || c == ']') {
      depth += c == '[' ? 1 : -1;
      begins_row = true;
      ++at;
    } else if (c == ',' || std::string_view(" \t\r\n").find(c) != std::string_view::npos) {
      ++at;
    } else if (const auto number = take_number(text, at)) {
      if (begins_row) rows.emplace_back();
      begins_row = false;
      rows.back().push_back(*number);
    } else {
      throw_file_error(file, in_quotes(text.substr(at, 12)) + " among the numbers of " + std::string(name), "numbers alone");
    }
    if (depth <= 0) return rows;
  }
  if (depth > 0) throw_file_error(file, "a file cut short in " + std::string(name), "a complete one");
  return rows;
}

Record3dMetadata parse_record3d_metadata(std::string_view text, const fs::path& file) {
  Record3dMetadata metadata;
  const Rows poses = rows_of(text, "poses", 7, file);
  for (std::size_t i = 0; i < poses.size(); ++i) {
    const std::vector<double>& p = poses[i];
    metadata.poses.push_back(
        pose_from_quaternion({p[4], p[5], p[6], p[0], p[1], p[2], p[3]}, file, "row " + std::to_string(i) + " of poses"));
  }
  for (const std::vector<double>& row : json_rows(text, "frameTimestamps", file)) {
    metadata.times_s.insert(metadata.times_s.end(), row.begin(), row.end());
  }
  const auto falls = [](double a, double b) { return !(a < b); };
  if (std::adjacent_find(metadata.times_s.begin(), metadata.times_s.end(), falls) != metadata.times_s.end()) metadata.times_s.clear();
  const double rate_hz = number_of(text, "fps", file);
  if (rate_hz >= 0.1 && rate_hz <= 1e3) metadata.frame_rate_hz = rate_hz;
  read_camera(text, file, metadata);
  return metadata;
}

}  // namespace foothold::io

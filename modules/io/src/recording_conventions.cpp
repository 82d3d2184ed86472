// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "recording_conventions.h"

#include "foothold/base/error.h"
#include "text_file.h"

namespace foothold::io {

namespace fs = std::filesystem;

DepthUnit settle_depth_unit(const FoundRecording& found, const RecordingCalibration& calibration, const SequenceOptions& options) {
  if (options.depth_units_per_m != 0.0) {
    if (!(options.depth_units_per_m > 0.0 && options.depth_units_per_m <= 1e6)) {
      throw InvalidSettings("depth scale: got " + numbers_text(&options.depth_units_per_m, 1) + ", expected depth units per metre, to 1e6");
    }
    return {depth_units_per_m(options.depth_units_per_m), "as given"};
  }
  const fs::path file = found.folder / "depth-scale.txt";
  if (fs::exists(file)) {
    const double value = parse_numbers(read_text(file, kMaxNumbersFileBytes), 1, file, "number of depth units per metre").front();
    if (!(value > 0.0 && value <= 1e6)) throw_file_error(file, numbers_text(&value, 1), "depth units per metre, to 1e6");
    return {depth_units_per_m(value), file.filename().string()};
  }
  if (calibration.depth_units_per_m.has_value()) return {*calibration.depth_units_per_m, "beside the intrinsics"};
  return {found.depth_units_per_m, found.depth_unit_source.empty() ? "as in all of this layout" : found.depth_unit_source};
}

PoseConvention settle_pose_convention(const FoundRecording& found, const SequenceOptions& options) {
  if (!options.pose_convention.empty()) return parse_pose_convention(options.pose_convention);
  const fs::path file = found.folder / "pose-convention.txt";
  if (!fs::exists(file)) return found.pose_convention;
  const std::string text = read_text(file, kMaxNumbersFileBytes);
  std::string words;
  for (const std::string_view word : split_words(text)) words += (words.empty() ? "" : ",") + std::string(word);
  try {
    return parse_pose_convention(words);
  } catch (const InvalidSettings& error) {
    throw FileError(file.string() + ": " + error.what());
  }
}

}  // namespace foothold::io

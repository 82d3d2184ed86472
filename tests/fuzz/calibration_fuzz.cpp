// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// The calibration files of a recording's folder together: what is accepted is a calibration of images of the asked sizes. Bytes 0xff
/// separate camera-intrinsics.txt, colour-intrinsics.txt, depth-from-colour.txt and what the user gave; the very first byte chooses the
/// sizes.
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "calibration_file.h"
#include "foothold/io/calibration.h"
#include "fuzz.h"

namespace foothold {
namespace {

constexpr const char* kFiles[] = {"camera-intrinsics.txt", "colour-intrinsics.txt", "depth-from-colour.txt"};
constexpr io::ImageSize kSizes[] = {{640, 480}, {320, 240}, {1296, 968}, {7, 5}};

/// A folder of this process, which goes with it.
class Folder {
 public:
  Folder() : path_(std::filesystem::temp_directory_path() / ("foothold-fuzz-" + std::to_string(::getpid()))) {
    std::filesystem::create_directories(path_);
  }
  ~Folder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;

  const std::filesystem::path& path() const { return path_; }

  /// An empty text is no file.
  void put(const char* name, const std::string& text) const {
    std::filesystem::remove(path_ / name);
    if (!text.empty()) std::ofstream(path_ / name, std::ios::binary) << text;
  }

 private:
  std::filesystem::path path_;
};

/// Cuts off what comes before the next 0xff.
std::string next_part(std::string& text) {
  const std::size_t end = std::min(text.find('\xff'), text.size());
  std::string part = text.substr(0, end);
  text.erase(0, std::min(end + 1, text.size()));
  return part;
}

void require_calibration(const RgbdCalibration& calibration) {
  fuzz::require(is_valid(calibration.depth) && is_valid(calibration.colour) && is_rigid(calibration.depth_from_colour, 1e-4F));
}

}  // namespace
}  // namespace foothold

FOOTHOLD_FUZZ_TARGET(calibration) {
  using namespace foothold;
  static const Folder folder;
  if (size == 0) return 0;
  std::string text = fuzz::text_of(data + 1, size - 1);
  for (const char* name : kFiles) folder.put(name, next_part(text));

  fuzz::attempt([&] { require_calibration(read_calibration(folder.path().string())); });
  SequenceOptions options;
  options.intrinsics = next_part(text);
  if (options.intrinsics.find_first_not_of("0123456789.,+-eE ") != std::string::npos) options.intrinsics.clear();  // would be a path
  io::CalibrationHints hints;
  hints.may_be_seven_scenes = (data[0] & 1U) != 0;
  const io::ImageSize depth_size = kSizes[(data[0] >> 1U) & 3U];
  const io::ImageSize colour_size = kSizes[(data[0] >> 3U) & 3U];
  fuzz::attempt([&] {
    const io::RecordingCalibration found = io::find_calibration(folder.path(), hints, depth_size, colour_size, options);
    require_calibration(found.pinholes());
    fuzz::require(found.depth.size == depth_size && found.colour.size == colour_size && !found.source.empty());
    fuzz::require(io::describe_impossible(found.depth.intrinsics, depth_size).empty());
  });
  return 0;
}

// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "sens_file.h"

#include <cstring>
#include <fstream>
#include <limits>

#include "text_file.h"

namespace foothold::io {
namespace {

namespace fs = std::filesystem;

constexpr std::uint32_t kVersion = 4;
constexpr std::uint64_t kMaxFrames = 10'000'000;
constexpr std::uint64_t kMaxImageBytes = 64U << 20U;

/// The error of a file that ends too early.
class CutShort : public FileError {
 public:
  CutShort(const fs::path& file, const std::string& where)
      : FileError(file.string() + ": got a file cut short " + where + ", expected a complete .sens file") {}
};

/// Reads little-endian numbers; complains where the file ends.
class Reader {
 public:
  Reader(std::istream& stream, const fs::path& file) : stream_(stream), file_(file) {
    stream_.seekg(0, std::ios::end);
    size_ = static_cast<std::uint64_t>(stream_.tellg());
    stream_.seekg(0);
  }

  template <class T>
  T number(const char* what) {
    T value{};
    if (!stream_.read(reinterpret_cast<char*>(&value), sizeof value)) {
      throw CutShort(file_, "before " + std::string(what));
    }
    return value;
  }
  std::vector<double> matrix(const char* what) {
    std::vector<double> numbers;
    for (int i = 0; i < 16; ++i) numbers.push_back(static_cast<double>(number<float>(what)));
    return numbers;
  }
  /// Steps over bytes. @return Where they begin.
  std::uint64_t skip(std::uint64_t num_bytes, const char* what) {
    const auto begin = static_cast<std::uint64_t>(stream_.tellg());
    if (num_bytes > size_ - begin) throw CutShort(file_, "in " + std::string(what));
    stream_.seekg(static_cast<std::streamoff>(begin + num_bytes));
    return begin;
  }

 private:
  std::istream& stream_;
  const fs::path& file_;
  std::uint64_t size_ = 0;
};

ImageCoding coding(std::int32_t value, std::initializer_list<ImageCoding> known, const char* what, const fs::path& file) {
  if (value >= 0 && value < static_cast<std::int32_t>(known.size())) return *(known.begin() + value);
  throw_file_error(file, std::string(what) + " of coding " + std::to_string(value), "one of 0 to " + std::to_string(known.size() - 1));
}

ImageSize image_size(Reader& reader, const char* what, const fs::path& file) {
  const auto width = reader.number<std::uint32_t>(what);
  const auto height = reader.number<std::uint32_t>(what);
  if (width == 0 || height == 0 || std::uint64_t{width} * height > kMaxImagePixels) {
    throw_file_error(file, std::string(what) + " of " + std::to_string(width) + "x" + std::to_string(height), "a size of images");
  }
  return {static_cast<int>(width), static_cast<int>(height)};
}

CameraModel camera(const std::vector<double>& matrix, const fs::path& file) {
  return parse_camera(numbers_text(matrix.data(), matrix.size()), file).camera;
}

SE3 extrinsics(const std::vector<double>& matrix, const fs::path& file) {
  return parse_transform(numbers_text(matrix.data(), matrix.size()), file);
}

RecordedFrame frame(Reader& reader, ImageCoding depth_coding, ImageCoding colour_coding, const fs::path& file) {
  RecordedFrame result;
  result.pose = pose_from_matrix(reader.matrix("a pose"), file);
  const auto colour_us = reader.number<std::uint64_t>("a time");
  const auto depth_us = reader.number<std::uint64_t>("a time");
  result.timestamp_s = 1e-6 * static_cast<double>(depth_us != 0 ? depth_us : colour_us);
  const auto colour_bytes = reader.number<std::uint64_t>("the size of an image");
  const auto depth_bytes = reader.number<std::uint64_t>("the size of an image");
  if (colour_bytes == 0 || depth_bytes == 0 || colour_bytes > kMaxImageBytes || depth_bytes > kMaxImageBytes) {
    throw_file_error(file, "images of " + std::to_string(colour_bytes) + " and " + std::to_string(depth_bytes) + " bytes", "1 to 64 MiB");
  }
  result.colour = {file, reader.skip(colour_bytes, "an image"), colour_bytes, colour_coding};
  result.depth = {file, reader.skip(depth_bytes, "an image"), depth_bytes, depth_coding};
  return result;
}

fs::path only_sens_file(const fs::path& folder) {
  std::vector<fs::path> files;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
    if (entry.path().extension() == ".sens") files.push_back(entry.path());
  }
  return files.size() == 1 ? files.front() : fs::path();
}

}  // namespace

SensContents parse_sens(std::istream& stream, const fs::path& file) {
  Reader reader(stream, file);
  const auto version = reader.number<std::uint32_t>("the version");
  if (version != kVersion) throw_file_error(file, "version " + std::to_string(version), "version 4 of .sens files");
  reader.skip(reader.number<std::uint64_t>("the sensor's name"), "the sensor's name");
  SensContents contents;
  contents.colour = camera(reader.matrix("the colour camera"), file);
  const SE3 common_from_colour = extrinsics(reader.matrix("the colour camera"), file);
  contents.depth = camera(reader.matrix("the depth camera"), file);
  contents.depth_from_colour = extrinsics(reader.matrix("the depth camera"), file).inverse() * common_from_colour;
  const ImageCoding colour_coding =
      coding(reader.number<std::int32_t>("the coding"), {ImageCoding::kRaw, ImageCoding::kFile, ImageCoding::kFile}, "colour", file);
  const ImageCoding depth_coding =
      coding(reader.number<std::int32_t>("the coding"), {ImageCoding::kRaw, ImageCoding::kZlibRaw}, "depth", file);
  contents.colour_size = image_size(reader, "colour", file);
  contents.depth_size = image_size(reader, "depth", file);
  contents.depth_units_per_m = static_cast<double>(reader.number<float>("the unit of depth"));
  if (!(contents.depth_units_per_m > 0.0 && contents.depth_units_per_m <= 1e6)) {
    throw_file_error(file, "depth in 1/" + std::to_string(contents.depth_units_per_m) + " m", "a depth unit");
  }
  const auto num_frames = reader.number<std::uint64_t>("the number of frames");
  if (num_frames == 0 || num_frames > kMaxFrames) throw_file_error(file, std::to_string(num_frames) + " frames", "1 to 10 million");
  try {
    for (std::uint64_t i = 0; i < num_frames; ++i) contents.frames.push_back(frame(reader, depth_coding, colour_coding, file));
  } catch (const CutShort& error) {
    if (2 * contents.frames.size() <= num_frames) throw;
    contents.cut_short = std::string(error.what()) + "; the first " + std::to_string(contents.frames.size()) + " of its " +
                         std::to_string(num_frames) + " frames are read";
  }
  return contents;
}

bool has_sens_file(const fs::path& folder) { return !only_sens_file(folder).empty(); }

FoundRecording read_sens_folder(const fs::path& folder, const Context& context) { return read_sens_file(only_sens_file(folder), context); }

FoundRecording read_sens_file(const fs::path& file, const Context& context) {
  std::ifstream stream(file, std::ios::binary);
  if (!stream) throw FileError(file.string() + ": cannot be opened for reading");
  SensContents contents = parse_sens(stream, file);
  if (!contents.cut_short.empty()) context.log(LogLevel::kWarning, contents.cut_short);
  FoundRecording found;
  found.folder = file.has_parent_path() ? file.parent_path() : fs::path(".");
  found.layout = "ScanNet (.sens)";
  found.frames = std::move(contents.frames);
  found.tells_poses = true;
  found.depth_units_per_m = contents.depth_units_per_m;
  found.depth_unit_source = file.filename().string();
  found.calibration.depth = contents.depth;
  found.calibration.colour = contents.colour;
  found.calibration.depth_from_colour = contents.depth_from_colour;
  found.calibration.header = file.string();
  found.raw_depth_size = contents.depth_size;
  found.raw_colour_size = contents.colour_size;
  return found;
}

}  // namespace foothold::io

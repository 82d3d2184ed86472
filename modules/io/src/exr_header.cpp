// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "exr_header.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <fstream>
#include <vector>

#include "image_decoding.h"
#include "text_file.h"

namespace foothold::io {
namespace {

namespace fs = std::filesystem;

constexpr const char* kExpectedExr = "a complete EXR image";
/// Bounds what a decoder takes: chunks have up to 32 lines of all channels.
constexpr std::int64_t kMaxExrSide = 8192;
constexpr std::size_t kMaxChannels = 4;
constexpr std::size_t kMaxExrHeaderBytes = 64U << 10U;
constexpr std::size_t kMaxExrHeadBytes = kMaxExrHeaderBytes + 8 * kMaxExrSide;  // with the places of the chunks

[[noreturn]] void throw_damaged_exr(const fs::path& name) {
  throw_file_error(name, "an EXR image cut short or with a damaged header", kExpectedExr);
}

/// Takes values off the front of a header.
class HeaderReader {
 public:
  HeaderReader(std::string_view bytes, const fs::path& name) : bytes_(bytes), name_(name) {}

  std::size_t position() const { return at_; }
  bool at_end_of_list() const { return at_ < bytes_.size() && bytes_[at_] == '\0'; }

  std::string_view take(std::size_t count) {
    if (count > bytes_.size() - at_) throw_damaged_exr(name_);
    at_ += count;
    return bytes_.substr(at_ - count, count);
  }
  std::int32_t take_int() {
    std::int32_t value = 0;
    std::memcpy(&value, take(sizeof value).data(), sizeof value);
    return value;
  }
  /// A text that a zero ends.
  std::string_view take_name() {
    const std::size_t end = bytes_.find('\0', at_);
    if (end == std::string_view::npos) throw_damaged_exr(name_);
    const std::string_view text = take(end - at_);
    take(1);
    return text;
  }

 private:
  std::string_view bytes_;
  const fs::path& name_;
  std::size_t at_ = 0;
};

/// The channel that holds depth.
std::string depth_channel(std::string_view list, const fs::path& name) {
  std::vector<std::string> channels;
  HeaderReader reader(list, name);
  while (!reader.at_end_of_list()) {
    channels.emplace_back(reader.take_name());
    const std::int32_t type = reader.take_int();
    reader.take_int();  // how it is perceived
    const bool is_whole = reader.take_int() == 1 && reader.take_int() == 1;
    const bool is_number = type == 1 || type == 2;  // 16 or 32 bits
    if (!is_whole || !is_number) throw OtherImage(name, "an EXR channel of integers or a part of the pixels", "floating-point depth");
  }
  if (reader.position() + 1 != list.size()) throw_damaged_exr(name);
  if (channels.size() == 1) return channels.front();
  for (const char* each : {"Z", "depth", "Depth", "Y", "R"}) {
    if (channels.size() <= kMaxChannels && std::find(channels.begin(), channels.end(), each) != channels.end()) return each;
  }
  throw OtherImage(name, "an EXR image of " + std::to_string(channels.size()) + " channels",
                   "a single one, or one called Z, depth, Y or R");
}

std::array<std::int32_t, 4> window_of(std::string_view box, const fs::path& name) {
  std::array<std::int32_t, 4> window{};
  if (box.size() != sizeof window) throw_damaged_exr(name);
  std::memcpy(window.data(), box.data(), box.size());
  return window;
}

ImageSize size_of_window(const std::array<std::int32_t, 4>& window, const fs::path& name) {
  constexpr std::int64_t kFar = 1 << 20;
  const auto [left, top, right, bottom] = window;
  const std::int64_t width = std::int64_t{right} - left + 1;
  const std::int64_t height = std::int64_t{bottom} - top + 1;
  const bool sane = width >= 1 && height >= 1 && std::abs(std::int64_t{left}) <= kFar && std::abs(std::int64_t{top}) <= kFar;
  if (!sane) throw_damaged_exr(name);
  if (width > kMaxExrSide || height > kMaxExrSide || width * height > kMaxImagePixels) {
    throw_file_error(name, "an EXR image of " + std::to_string(width) + "x" + std::to_string(height) + " pixels",
                     "at most " + std::to_string(kMaxExrSide) + " a side and " + std::to_string(kMaxImagePixels) + " in all");
  }
  return {static_cast<int>(width), static_cast<int>(height)};
}

/// Lines that are compressed together.
std::size_t lines_of_chunk(std::string_view compression, const fs::path& name) {
  constexpr std::array<std::size_t, 6> kLines{1, 1, 1, 16, 32, 16};  // none, RLE, ZIPS, ZIP, PIZ, PXR24
  if (compression.size() != 1) throw_damaged_exr(name);
  const auto kind = static_cast<unsigned char>(compression[0]);
  if (kind < kLines.size()) return kLines[kind];
  throw OtherImage(name, "an EXR image of compression " + std::to_string(kind), "none, RLE, ZIP, PIZ or PXR24");
}

void check_version(HeaderReader& reader, const fs::path& name) {
  constexpr std::string_view kMagic = "\x76\x2f\x31\x01";
  if (reader.take(kMagic.size()) != kMagic) throw_file_error(name, "a file without the signature of EXR images", kExpectedExr);
  constexpr std::uint32_t kVersion = 2;
  constexpr std::uint32_t kLongNames = 0x400;
  const auto version = static_cast<std::uint32_t>(reader.take_int());
  if ((version & 0xffU) != kVersion || (version & ~(0xffU | kLongNames)) != 0) {
    throw OtherImage(name, "an EXR image in tiles, of several parts, of deep pixels or of another version", "scan lines");
  }
}

std::string first_bytes_of(const fs::path& file, std::size_t count) {
  std::ifstream stream(file, std::ios::binary);
  std::string bytes(count, '\0');
  stream.read(bytes.data(), static_cast<std::streamsize>(count));
  if (stream.bad() || stream.gcount() == 0) throw FileError(file.string() + ": cannot be read");
  bytes.resize(static_cast<std::size_t>(stream.gcount()));
  return bytes;
}

}  // namespace

ExrHeader parse_exr_header(std::string_view bytes, const fs::path& name) {
  HeaderReader reader(bytes.substr(0, kMaxExrHeaderBytes), name);
  check_version(reader, name);
  ExrHeader header;
  std::size_t lines = 0;
  while (!reader.at_end_of_list()) {
    const std::string_view attribute = reader.take_name();
    reader.take_name();  // its type
    const std::int32_t size = reader.take_int();
    if (size < 0) throw_damaged_exr(name);
    const std::string_view value = reader.take(static_cast<std::size_t>(size));
    if (attribute == "channels") {
      header.channel = depth_channel(value, name);
      header.channels = value;
    } else if (attribute == "dataWindow") {
      header.window = window_of(value, name);
      header.size = size_of_window(header.window, name);
    } else if (attribute == "compression") {
      lines = lines_of_chunk(value, name);
      header.compression = value[0];
    }
  }
  if (header.channel.empty() || header.size.empty() || lines == 0) throw_damaged_exr(name);
  header.num_bytes = reader.position() + 1;
  header.num_chunks = (static_cast<std::size_t>(header.size.height) + lines - 1) / lines;
  return header;
}

ExrHeader parse_exr_head(std::string_view head, std::uintmax_t file_size, const fs::path& file) {
  const ExrHeader header = parse_exr_header(head, file);
  HeaderReader reader(head, file);
  reader.take(header.num_bytes);
  for (std::size_t i = 0; i < header.num_chunks; ++i) {
    std::uint64_t place = 0;
    std::memcpy(&place, reader.take(sizeof place).data(), sizeof place);
    if (place < header.num_bytes + sizeof place * header.num_chunks || place >= file_size)
      throw_file_error(file, "an EXR image cut short", kExpectedExr);
  }
  return header;
}

void check_exr_file(const fs::path& file) {
  constexpr std::size_t kUsualHeadBytes = 8U << 10U;
  if (!fs::is_regular_file(file)) throw FileError(file.string() + ": is no file that can be read");
  const std::uintmax_t size = fs::file_size(file);
  if (size == 0) throw_file_error(file, "an empty file", kExpectedExr);
  try {
    parse_exr_head(first_bytes_of(file, kUsualHeadBytes), size, file);
  } catch (const FileError&) {
    parse_exr_head(first_bytes_of(file, kMaxExrHeadBytes), size, file);
  }
}

}  // namespace foothold::io

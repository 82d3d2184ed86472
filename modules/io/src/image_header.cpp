// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "image_header.h"

#include <cctype>
#include <cmath>
#include <cstdint>

namespace foothold::io {
namespace {

constexpr std::uint32_t kMaxSide = 1U << 20U;

/// A big-endian number of `count` bytes. @pre They are there.
std::uint32_t number_at(std::string_view bytes, std::size_t at, std::size_t count) {
  std::uint32_t value = 0;
  for (std::size_t i = at; i < at + count; ++i) value = value << 8U | static_cast<unsigned char>(bytes[i]);
  return value;
}

std::optional<ImageHeader> header(std::uint32_t width, std::uint32_t height, int num_channels, int bits) {
  if (width == 0 || height == 0 || width > kMaxSide || height > kMaxSide || num_channels == 0 || bits == 0) return std::nullopt;
  return ImageHeader{{static_cast<int>(width), static_cast<int>(height)}, num_channels, bits};
}

/// Reference: the PNG specification, IHDR.
std::optional<ImageHeader> parse_png(std::string_view bytes) {
  constexpr std::size_t kHeaderEnd = 26;
  if (bytes.size() < kHeaderEnd || bytes.substr(12, 4) != "IHDR") return std::nullopt;
  const std::uint32_t kind = number_at(bytes, 25, 1);
  const int bits = static_cast<int>(number_at(bytes, 24, 1));
  const int num_channels = kind == 0 ? 1 : kind == 4 ? 2 : kind == 6 ? 4 : kind == 2 || kind == 3 ? 3 : 0;
  return header(number_at(bytes, 16, 4), number_at(bytes, 20, 4), num_channels, kind == 3 ? 8 : bits);
}

/// Walks the markers to the start of the frame. Reference: ITU-T T.81, B.2.
std::optional<ImageHeader> parse_jpeg(std::string_view bytes) {
  for (std::size_t at = 2; at + 10 <= bytes.size();) {
    if (bytes[at] != '\xff') return std::nullopt;
    const std::uint32_t marker = number_at(bytes, at + 1, 1);
    if (marker == 0xff) {  // padding
      ++at;
      continue;
    }
    const bool is_frame = marker >= 0xc0 && marker <= 0xcf && marker != 0xc4 && marker != 0xc8 && marker != 0xcc;
    if (is_frame) {
      return header(number_at(bytes, at + 7, 2), number_at(bytes, at + 5, 2), static_cast<int>(number_at(bytes, at + 9, 1)),
                    static_cast<int>(number_at(bytes, at + 4, 1)));
    }
    at += 2 + number_at(bytes, at + 2, 2);
  }
  return std::nullopt;
}

/// Reads a number of a PGM header, behind blanks and comments; 0 if there is none, or no blank behind it: decoders disagree on what such a
/// header says.
std::uint32_t next_number(std::string_view bytes, std::size_t& at) {
  const auto is_blank = [&](std::size_t place) { return std::isspace(static_cast<unsigned char>(bytes[place])) != 0; };
  while (at < bytes.size() && (is_blank(at) || bytes[at] == '#')) {
    if (bytes[at] == '#') at = std::min(bytes.find_first_of("\r\n", at), bytes.size() - 1);
    ++at;
  }
  std::uint32_t value = 0;
  for (; at < bytes.size() && std::isdigit(static_cast<unsigned char>(bytes[at])) != 0 && value <= kMaxSide; ++at) {
    value = 10 * value + static_cast<std::uint32_t>(bytes[at] - '0');
  }
  return at < bytes.size() && is_blank(at) ? value : 0;
}

/// Without a blank behind the magic, OpenCV takes the bytes for another format's.
std::optional<ImageHeader> parse_pnm(std::string_view bytes) {
  std::size_t at = 2;
  if (std::isspace(static_cast<unsigned char>(bytes[at])) == 0) return std::nullopt;
  const std::uint32_t width = next_number(bytes, at);
  const std::uint32_t height = next_number(bytes, at);
  const std::uint32_t max_value = next_number(bytes, at);
  const int bits = max_value == 0 || max_value > 65535 ? 0 : max_value < 256 ? 8 : 16;
  const std::optional<ImageHeader> result = header(width, height, bytes[1] == '6' ? 3 : 1, bits);
  if (!result.has_value()) return result;
  const std::uint64_t num_bytes = std::uint64_t{width} * height * static_cast<unsigned>(result->num_channels * bits / 8);
  return at + 1 + num_bytes <= bytes.size() ? result : std::nullopt;
}

}  // namespace

std::string to_string(const ImageSize& size) { return std::to_string(size.width) + "x" + std::to_string(size.height); }

bool same_shape(const ImageSize& a, const ImageSize& b) {
  constexpr double kTolerance = 0.01;
  const double ratio = static_cast<double>(a.width) * b.height / (static_cast<double>(a.height) * b.width);
  return std::abs(ratio - 1.0) <= kTolerance;
}

std::optional<ImageHeader> parse_image_header(std::string_view bytes) {
  using namespace std::string_view_literals;
  if (bytes.substr(0, 8) == "\x89PNG\r\n\x1a\n"sv) return parse_png(bytes);
  if (bytes.substr(0, 3) == "\xff\xd8\xff"sv) return parse_jpeg(bytes);
  if (bytes.size() > 2 && bytes[0] == 'P' && (bytes[1] == '5' || bytes[1] == '6')) return parse_pnm(bytes);
  return std::nullopt;
}

}  // namespace foothold::io

// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "text_file.h"

#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstring>
#include <fstream>

namespace foothold::io {

void throw_file_error(const std::filesystem::path& file, const std::string& found, const std::string& expected) {
  throw FileError(file.string() + ": got " + found + ", expected " + expected);
}

std::string read_file(const std::filesystem::path& file, std::size_t max_bytes) {
  std::error_code error;
  const auto status = std::filesystem::status(file, error);
  if (status.type() == std::filesystem::file_type::not_found) throw FileError(file.string() + ": no such file");
  if (std::filesystem::is_directory(status)) throw_file_error(file, "a folder", "a file");
  errno = 0;
  std::ifstream stream(file, std::ios::binary);
  if (!stream) throw FileError(file.string() + ": cannot be opened for reading: " + std::strerror(errno));
  std::string bytes;
  char block[1U << 16U];
  while (stream.read(block, sizeof block) || stream.gcount() > 0) {
    bytes.append(block, static_cast<std::size_t>(stream.gcount()));
    if (bytes.size() > max_bytes) {
      throw_file_error(file, "more than " + std::to_string(max_bytes) + " bytes", "a smaller file of this kind");
    }
  }
  if (stream.bad()) throw FileError(file.string() + ": reading failed: " + std::strerror(errno));
  return bytes;
}

std::string in_quotes(std::string_view text) {
  constexpr std::size_t kMaxLength = 60;
  std::string result = "'";
  for (const char c : text.substr(0, kMaxLength)) result += static_cast<unsigned char>(c) < 0x20 || c == 0x7f ? '?' : c;
  return result + (text.size() > kMaxLength ? "...'" : "'");
}

std::vector<std::string_view> split_words(std::string_view text) {
  constexpr std::string_view kBlanks = " \t\r\n\v\f";
  std::vector<std::string_view> words;
  for (std::size_t begin = text.find_first_not_of(kBlanks); begin != std::string_view::npos;) {
    const std::size_t end = std::min(text.find_first_of(kBlanks, begin), text.size());
    words.push_back(text.substr(begin, end - begin));
    begin = text.find_first_not_of(kBlanks, end);
  }
  return words;
}

std::vector<TextLine> split_lines(std::string_view text) {
  std::vector<TextLine> lines;
  int number = 0;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    TextLine line{++number, split_words(text.substr(0, end))};
    text.remove_prefix(std::min(end + 1, text.size()));
    if (!line.words.empty() && line.words.front().front() != '#') lines.push_back(std::move(line));
  }
  return lines;
}

double parse_number(std::string_view word, const std::filesystem::path& file, const std::string& what) {
  std::string_view digits = word;
  if (digits.size() > 1 && digits[0] == '+' && digits[1] != '-') digits.remove_prefix(1);
  double value = 0.0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  const bool complete = !digits.empty() && error == std::errc() && end == digits.data() + digits.size();
  if (!complete || !std::isfinite(value)) throw_file_error(file, in_quotes(word), "a finite number as " + what);
  return value;
}

std::vector<double> parse_numbers(std::string_view text, std::size_t count, const std::filesystem::path& file, const std::string& what) {
  const std::vector<std::string_view> words = split_words(text);
  if (words.size() != count) throw_file_error(file, std::to_string(words.size()) + " numbers", std::to_string(count) + " for a " + what);
  std::vector<double> numbers;
  for (const std::string_view word : words) {
    numbers.push_back(parse_number(word, file, "entry " + std::to_string(numbers.size() + 1) + " of a " + what));
  }
  return numbers;
}

}  // namespace foothold::io

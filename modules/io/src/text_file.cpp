// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "text_file.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <sstream>

namespace foothold::io {
namespace {

constexpr std::string_view kBlanks = " \t\r\n\v\f";

/// UTF-16 as UTF-8. What is beyond the basic plane is no part of lists of numbers, and becomes '?'.
/// @param high  the place of the higher byte: 0 or 1
std::string from_utf16(std::string_view bytes, std::size_t high) {
  std::string text;
  for (std::size_t i = 0; i + 1 < bytes.size(); i += 2) {
    const unsigned unit =
        static_cast<unsigned char>(bytes[i + high]) << 8U | static_cast<unsigned>(static_cast<unsigned char>(bytes[i + 1 - high]));
    if (unit < 0x80) {
      text += static_cast<char>(unit);
    } else if (unit < 0x800) {
      text += {static_cast<char>(0xc0 | unit >> 6U), static_cast<char>(0x80 | (unit & 0x3fU))};
    } else if (unit >= 0xd800 && unit < 0xe000) {
      text += '?';
    } else {
      text +=
          {static_cast<char>(0xe0 | unit >> 12U), static_cast<char>(0x80 | (unit >> 6U & 0x3fU)), static_cast<char>(0x80 | (unit & 0x3fU))};
    }
  }
  return text;
}

/// True if a line is a row of values with a separator between them: blanks, if any, stand beside separators only.
bool is_separated_by(char separator, std::string_view line) {
  if (line.find(separator) == std::string_view::npos) return false;
  const std::vector<std::string_view> words = split_words(line);
  for (std::size_t i = 0; i + 1 < words.size(); ++i) {
    if (words[i].back() != separator && words[i + 1].front() != separator) return false;
  }
  return true;
}

constexpr std::string_view kDigits = "0123456789";

/// True for a number with a comma between its digits and no point, such as "-0,5".
bool has_decimal_comma(std::string_view word) {
  const std::size_t comma = word.find(',');
  if (comma == std::string_view::npos || word.find_first_not_of("0123456789,+-eE") != std::string_view::npos) return false;
  return word.find_last_of(kDigits, comma) + 1 == comma && word.find_first_of(kDigits, comma) == comma + 1 &&
         word.find(',', comma + 1) == std::string_view::npos;
}

/// Turns decimal commas into points in a row that tabs separate.
void mend_decimal_commas(std::string& text, std::string_view line) {
  if (line.find('\t') == std::string_view::npos) return;
  for (const std::string_view word : split_words(line)) {
    if (has_decimal_comma(word)) text[static_cast<std::size_t>(word.data() - text.data()) + word.find(',')] = '.';
  }
}

void separate_by_blanks(std::string& text, std::size_t begin, std::size_t end) {
  const std::string_view line = std::string_view(text).substr(begin, end - begin);
  const char separator = is_separated_by(';', line) ? ';' : is_separated_by(',', line) ? ',' : '\0';
  if (separator == '\0') return mend_decimal_commas(text, line);
  for (std::size_t i = begin; i < end; ++i) {
    if (text[i] == separator || text[i] == '"') {
      text[i] = ' ';
    } else if (text[i] == ',') {
      text[i] = '.';
    }
  }
}

/// True for the name of a table's first column.
bool is_heading(std::string_view word) {
  constexpr std::array<std::string_view, 6> kNames{"time", "stamp", "%time", "frame", "index", "sec"};
  if (word == "t") return true;
  std::string lower(word.substr(0, 16));
  for (char& c : lower) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return std::any_of(kNames.begin(), kNames.end(), [&](std::string_view name) { return lower.rfind(name, 0) == 0; });
}

}  // namespace

std::string read_text(const std::filesystem::path& file, std::size_t max_bytes) { return plain_text(read_file(file, max_bytes)); }

std::string plain_text(std::string text) {
  using namespace std::string_view_literals;
  const std::string_view view = text;
  if (view.substr(0, 3) == "\xef\xbb\xbf"sv) text.erase(0, 3);
  const auto has_zeros_at = [&](std::size_t i) { return view.size() > 3 && view[i] == '\0' && view[i + 2] == '\0'; };
  if (view.substr(0, 2) == "\xff\xfe"sv || view.substr(0, 2) == "\xfe\xff"sv) {
    text = from_utf16(view.substr(2), view[0] == '\xfe' ? 0 : 1);
  } else if (has_zeros_at(0) != has_zeros_at(1)) {  // UTF-16 without a mark
    text = from_utf16(view, has_zeros_at(0) ? 0 : 1);
  }
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] == '\r') text[i] = i + 1 < text.size() && text[i + 1] == '\n' ? ' ' : '\n';
  }
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    separate_by_blanks(text, begin, end);
    begin = end + 1;
  }
  return text;
}

std::string bare_numbers(std::string_view text) {
  const auto is_letter = [](char c) { return std::isalpha(static_cast<unsigned char>(c)) != 0; };
  std::string bare;
  bool in_comment = false;
  bool in_word = false;  // between the parentheses of a word such as "nan(ind)"
  for (const char c : text) {
    const bool after_blank = bare.empty() || kBlanks.find(bare.back()) != std::string_view::npos;
    in_comment = (c == '#' && after_blank) || (in_comment && c != '\n');
    const bool opens_word = c == '(' && !after_blank && is_letter(bare.back());
    const bool is_bracket = c == '[' || c == ']' || (c == '(' && !opens_word) || (c == ')' && !in_word);
    in_word = opens_word || (in_word && c != ')');
    bare += in_comment || is_bracket || c == ';' ? ' ' : c;
  }
  for (std::size_t i = 0; i < bare.size(); ++i) {  // a comma between digits may be a decimal one
    if (bare[i] == ',' && (i + 1 == bare.size() || std::isspace(static_cast<unsigned char>(bare[i + 1])) != 0)) bare[i] = ' ';
  }
  return bare;
}

std::vector<std::string_view> split_words(std::string_view text) {
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
    if (line.words.empty() || line.words.front().front() == '#') continue;
    if (lines.empty() && line.words.size() > 1 && is_heading(line.words.front())) continue;
    lines.push_back(std::move(line));
  }
  return lines;
}

double parse_number(std::string_view word, const std::filesystem::path& file, const std::string& what) {
  std::string_view digits = word;
  if (digits.size() > 1 && digits[0] == '+' && digits[1] != '-') digits.remove_prefix(1);
  double value = 0.0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  const bool complete = !digits.empty() && error == std::errc() && end == digits.data() + digits.size();
  if (complete && std::isfinite(value)) return value;
  throw_file_error(file, in_quotes(word),
                   std::string("a finite number") + (has_decimal_comma(word) ? " with a decimal point" : "") + " as " + what);
}

bool is_not_finite(std::string_view word) {
  if (!word.empty() && (word.front() == '-' || word.front() == '+')) word.remove_prefix(1);
  std::string lower(word.substr(0, 8));
  for (char& c : lower) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return lower.rfind("nan", 0) == 0 || lower.rfind("inf", 0) == 0 || lower.rfind("1.#", 0) == 0;
}

std::string numbers_text(const double* numbers, std::size_t count) {
  std::ostringstream text;
  text.precision(9);
  for (std::size_t i = 0; i < count; ++i) text << (i == 0 ? "" : " ") << numbers[i];
  return text.str();
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

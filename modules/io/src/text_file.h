// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// Reading small text files, with messages that name file, value and expectation.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "foothold/base/input_file.h"
#include "foothold/base/printable.h"

namespace foothold::io {

/// The text of a file, by read_file() and plain_text(). @throws FileError
std::string read_text(const std::filesystem::path& file, std::size_t max_bytes);

/// Text as Windows, spreadsheets and loggers write it, made plain: byte-order marks are dropped, UTF-16 becomes UTF-8 with or without one,
/// lines end in '\n', and in lines of comma- or semicolon-separated values blanks take the place of separators and quotes. Where semicolons
/// or tabs separate, decimal commas become points.
std::string plain_text(std::string text);

/// A text without its comments, brackets, and commas and semicolons behind numbers: what remains of a matrix in most notations.
std::string bare_numbers(std::string_view text);

/// The words of a text, separated by blanks and line ends.
std::vector<std::string_view> split_words(std::string_view text);

/// A line of a list, with its number for messages.
struct TextLine {
  int number = 0;  ///< 1 for the first
  std::vector<std::string_view> words;
};

/// The lines of a text that hold words, do not begin with '#', and are not a table's heading: a first line that begins with the name of a
/// column, such as "timestamp".
std::vector<TextLine> split_lines(std::string_view text);

/// Parses a finite number. @param what  what the number is, for the message. @throws FileError
double parse_number(std::string_view word, const std::filesystem::path& file, const std::string& what);

/// True for a word by which printf() writes what is not a finite number: "nan", "-inf", "-1.#IND".
bool is_not_finite(std::string_view word);

/// Numbers as text, separated by blanks.
std::string numbers_text(const double* numbers, std::size_t count);

/// Parses a text of exactly `count` finite numbers. @param what  such as "4x4 pose". @throws FileError
std::vector<double> parse_numbers(std::string_view text, std::size_t count, const std::filesystem::path& file, const std::string& what);

/// Largest size of a file of a few numbers [bytes]; more is the wrong file.
inline constexpr std::size_t kMaxNumbersFileBytes = 64U << 10U;
/// Largest size of a list of frames or a JSON file [bytes].
inline constexpr std::size_t kMaxListFileBytes = 256U << 20U;

}  // namespace foothold::io

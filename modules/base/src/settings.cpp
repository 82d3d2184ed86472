// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "foothold/base/settings.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <numeric>
#include <system_error>

#include "foothold/base/printable.h"

namespace foothold {
namespace {

constexpr std::size_t kMaxQuoted = 60;  ///< characters of what a user or a file gave, in messages

/// Levenshtein's edit distance, for "did you mean".
std::size_t edit_distance(const std::string& a, const std::string& b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t substitute = diagonal + (a[i - 1] == b[j - 1] ? 0 : 1);
      diagonal = row[j];
      row[j] = std::min({row[j] + 1, row[j - 1] + 1, substitute});
    }
  }
  return row[b.size()];
}

}  // namespace

namespace detail {

std::string to_text(bool value) { return value ? "true" : "false"; }
std::string to_text(long long value) { return std::to_string(value); }
std::string to_text(unsigned long long value) { return std::to_string(value); }

namespace {
/// The shortest text that reads back as the same number; plain digits for the magnitudes that settings have.
template <class T>
std::string shortest_text(T value) {
  const double magnitude = std::abs(static_cast<double>(value));
  const bool plain = magnitude == 0.0 || (magnitude >= 1e-5 && magnitude < 1e10);
  char text[64];
  const auto [end, error] =
      std::to_chars(text, text + sizeof(text), value, plain ? std::chars_format::fixed : std::chars_format::scientific);
  return error == std::errc() ? std::string(text, end) : std::string();
}
}  // namespace

std::string to_text(double value) { return shortest_text(value); }
std::string to_text(float value) { return shortest_text(value); }

std::string range_text(const Range& range) { return "[" + to_text(range.low) + ", " + to_text(range.high) + "]"; }

bool parse_bool(const std::string& path, const std::string& text) {
  if (text == "true" || text == "1") return true;
  if (text == "false" || text == "0") return false;
  throw InvalidSettings("setting " + path + ": got '" + printable(text, kMaxQuoted) + "', expected true or false");
}

namespace {
/// Compares in the number's own precision, and prints it so.
template <class T>
void check_in_range(const std::string& path, T value, const Range& range) {
  if (std::isfinite(value) && value >= static_cast<T>(range.low) && value <= static_cast<T>(range.high)) return;
  throw InvalidSettings("setting " + path + ": got " + to_text(value) + ", expected a value in " + range_text(range));
}
}  // namespace

void check_range(const std::string& path, double value, const Range& range) { check_in_range(path, value, range); }
void check_range(const std::string& path, float value, const Range& range) { check_in_range(path, value, range); }

// std::from_chars wants the whole text to be the number, and neither skips blanks nor heeds the host's locale.
double parse_number(const std::string& path, const std::string& text, const Range& range, bool integer) {
  double value = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  const bool complete = error == std::errc() && end == text.data() + text.size();
  if (!complete || (integer && std::floor(value) != value)) {
    throw InvalidSettings("setting " + path + ": got '" + printable(text, kMaxQuoted) + "', expected " +
                          (integer ? "an integer in " : "a number in ") + range_text(range));
  }
  check_range(path, value, range);
  return value;
}

unsigned long long parse_unsigned(const std::string& path, const std::string& text, unsigned long long max) {
  unsigned long long value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size() || value > max) {
    throw InvalidSettings("setting " + path + ": got '" + printable(text, kMaxQuoted) + "', expected an integer from 0 to " +
                          std::to_string(max));
  }
  return value;
}

void throw_unknown_setting(const std::string& path, const std::vector<SettingDescription>& known) {
  const auto nearest = std::min_element(
      known.begin(), known.end(), [&](const auto& a, const auto& b) { return edit_distance(path, a.path) < edit_distance(path, b.path); });
  std::string message = "unknown setting '" + printable(path, kMaxQuoted) + "'";
  if (nearest != known.end()) message += "; did you mean '" + nearest->path + "'?";
  throw InvalidSettings(message);
}

}  // namespace detail
}  // namespace foothold

// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "foothold/base/settings.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <numeric>
#include <sstream>

namespace foothold {
namespace {

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

std::string to_text(double value) {
  std::ostringstream stream;
  stream.precision(17);
  for (int digits = 1; digits <= 17; ++digits) {
    std::ostringstream shortest;
    shortest.precision(digits);
    shortest << value;
    if (std::strtod(shortest.str().c_str(), nullptr) == value) return shortest.str();
  }
  stream << value;
  return stream.str();
}

std::string to_text(float value) {
  for (int digits = 1; digits <= 9; ++digits) {
    std::ostringstream shortest;
    shortest.precision(digits);
    shortest << value;
    if (std::strtof(shortest.str().c_str(), nullptr) == value) return shortest.str();
  }
  return to_text(static_cast<double>(value));
}

std::string range_text(const Range& range) { return "[" + to_text(range.low) + ", " + to_text(range.high) + "]"; }

bool parse_bool(const std::string& path, const std::string& text) {
  if (text == "true" || text == "1") return true;
  if (text == "false" || text == "0") return false;
  throw InvalidSettings("setting " + path + ": got '" + text + "', expected true or false");
}

void check_range(const std::string& path, double value, const Range& range) {
  if (std::isfinite(value) && value >= range.low && value <= range.high) return;
  throw InvalidSettings("setting " + path + ": got " + to_text(value) + ", expected a value in " + range_text(range));
}

double parse_number(const std::string& path, const std::string& text, const Range& range, bool integer) {
  char* end = nullptr;
  const double value = std::strtod(text.c_str(), &end);
  const bool complete = !text.empty() && end == text.c_str() + text.size();
  if (!complete || (integer && std::floor(value) != value)) {
    throw InvalidSettings("setting " + path + ": got '" + text + "', expected " + (integer ? "an integer in " : "a number in ") +
                          range_text(range));
  }
  check_range(path, value, range);
  return value;
}

unsigned long long parse_unsigned(const std::string& path, const std::string& text) {
  char* end = nullptr;
  const unsigned long long value = std::strtoull(text.c_str(), &end, 10);
  const bool complete = !text.empty() && end == text.c_str() + text.size() && text[0] != '-';
  if (!complete) throw InvalidSettings("setting " + path + ": got '" + text + "', expected a non-negative integer");
  return value;
}

void throw_unknown_setting(const std::string& path, const std::vector<SettingDescription>& known) {
  const auto nearest = std::min_element(
      known.begin(), known.end(), [&](const auto& a, const auto& b) { return edit_distance(path, a.path) < edit_distance(path, b.path); });
  std::string message = "unknown setting '" + path + "'";
  if (nearest != known.end()) message += "; did you mean '" + nearest->path + "'?";
  throw InvalidSettings(message);
}

}  // namespace detail
}  // namespace foothold

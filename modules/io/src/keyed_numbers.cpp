// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "keyed_numbers.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>

namespace foothold::io {
namespace {

bool is_letter(char c) { return std::isalpha(static_cast<unsigned char>(c)) != 0 || c == '_'; }
bool is_name_part(char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_' || c == '-' || c == '.'; }

std::string normalised(std::string_view name) {
  const std::size_t dot = name.rfind('.');
  if (dot != std::string_view::npos && dot + 1 < name.size()) name.remove_prefix(dot + 1);
  std::string key;
  for (const char c : name) {
    if (c != '_' && c != '-') key += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  }
  return key;
}

/// Names inside the description of a matrix, which are not the matrix's own.
bool describes_matrix(const std::string& key) {
  constexpr std::array<std::string_view, 8> kKeys{"rows", "cols", "dt", "d", "f", "opencvmatrix", "type", "data"};
  return std::find(kKeys.begin(), kKeys.end(), key) != kKeys.end();
}

/// The name of the matrix whose data come next.
std::string matrix_name(const std::vector<KeyedNumbers>& before) {
  const auto named = std::find_if(before.rbegin(), before.rend(), [](const KeyedNumbers& entry) { return !describes_matrix(entry.key); });
  return named == before.rend() ? "data" : named->key;
}

using Words = std::initializer_list<std::string_view>;

bool mentions(const std::string& key, Words words) {
  return std::any_of(words.begin(), words.end(), [&](std::string_view word) { return key.find(word) != std::string::npos; });
}

/// One of the two parts that section() tells of; empty if there is none.
std::vector<KeyedNumbers> part_about(const std::vector<KeyedNumbers>& all, Words own, Words other) {
  constexpr std::size_t kLeastNumbers = 4;
  const auto is_heading = [](const KeyedNumbers& entry, Words words, Words others) {
    return entry.numbers.empty() && mentions(entry.key, words) && !mentions(entry.key, others);
  };
  for (auto begin = all.begin(); begin != all.end(); ++begin) {
    if (!is_heading(*begin, own, other)) continue;
    const auto end = std::find_if(begin, all.end(), [&](const KeyedNumbers& entry) { return is_heading(entry, other, own); });
    std::size_t count = 0;
    std::for_each(begin, end, [&](const KeyedNumbers& entry) { count += entry.numbers.size(); });
    if (count >= kLeastNumbers) return {begin, end};
    begin = end - 1;
  }
  return {};
}

}  // namespace

bool has_keys(std::string_view text) { return text.find_first_of(":={") != std::string_view::npos; }

std::vector<KeyedNumbers> parse_keyed_numbers(std::string_view text) {
  std::vector<KeyedNumbers> all;
  const char* at = text.data();
  const char* const end = text.data() + text.size();
  while (at < end) {
    if (*at == '#') {
      at = std::find(at, end, '\n');
    } else if (is_letter(*at)) {
      const char* const behind = std::find_if_not(at, end, is_name_part);
      const std::string key = normalised({at, static_cast<std::size_t>(behind - at)});
      all.push_back({key == "data" ? matrix_name(all) : key, {}});
      at = behind;
    } else {
      double number = 0.0;
      const auto [behind, error] = std::from_chars(at, end, number);
      if (error == std::errc() && !all.empty()) all.back().numbers.push_back(number);
      at = behind == at ? at + 1 : behind;
    }
  }
  return all;
}

std::vector<double> find_numbers(const std::vector<KeyedNumbers>& all, std::initializer_list<std::string_view> keys, std::size_t count) {
  for (const std::string_view key : keys) {
    const auto found =
        std::find_if(all.begin(), all.end(), [&](const KeyedNumbers& entry) { return entry.key == key && entry.numbers.size() == count; });
    if (found != all.end()) return found->numbers;
  }
  return {};
}

std::vector<KeyedNumbers> section(const std::vector<KeyedNumbers>& all, Words own, Words other) {
  const std::vector<KeyedNumbers> part = part_about(all, own, other);
  return part.empty() || part_about(all, other, own).empty() ? all : part;
}

}  // namespace foothold::io

// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// Numbers by name, from whatever notation people chose: JSON, YAML, "key = value".
#pragma once

#include <initializer_list>
#include <string>
#include <string_view>
#include <vector>

namespace foothold::io {

struct KeyedNumbers {
  /// In lower case, without '_' and '-' and what precedes the last '.'; of OpenCV's and ROS's matrices their name instead of "data".
  std::string key;
  std::vector<double> numbers;
};

/// True if a text names its numbers.
bool has_keys(std::string_view text);

/// The names of a text, each with the numbers that follow it. '#' begins a comment. Never fails.
std::vector<KeyedNumbers> parse_keyed_numbers(std::string_view text);

/// The numbers of the first of some keys that stands in a text with that many of them; empty if none does.
std::vector<double> find_numbers(const std::vector<KeyedNumbers>& all, std::initializer_list<std::string_view> keys, std::size_t count);

/// The part of a text that tells of one of two things: from a name without numbers that contains one of the words `own` to the next that
/// contains one of `other`. Everything if the text has no such part of each with at least four numbers.
std::vector<KeyedNumbers> section(const std::vector<KeyedNumbers>& all, std::initializer_list<std::string_view> own,
                                  std::initializer_list<std::string_view> other);

}  // namespace foothold::io

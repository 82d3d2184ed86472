// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// Numbers and arrays in binary streams, for saving scenes.
#pragma once

#include <cstdint>
#include <istream>
#include <ostream>
#include <string>
#include <type_traits>
#include <vector>

#include "foothold/base/error.h"

namespace foothold {

/// Writes a trivially copyable value as its bytes. The stream's state tells of failure.
template <class T>
void write_value(std::ostream& stream, const T& value) {
  static_assert(std::is_trivially_copyable_v<T>);
  stream.write(reinterpret_cast<const char*>(&value), sizeof(T));
}

/// Writes a count and the elements' bytes.
template <class T>
void write_array(std::ostream& stream, const std::vector<T>& values) {
  static_assert(std::is_trivially_copyable_v<T>);
  write_value(stream, static_cast<std::uint64_t>(values.size()));
  stream.write(reinterpret_cast<const char*>(values.data()), static_cast<std::streamsize>(values.size() * sizeof(T)));
}

/// Reads what write_value() wrote. @throws FileError naming `what` if the stream ends.
template <class T>
T read_value(std::istream& stream, const std::string& what) {
  T value{};
  stream.read(reinterpret_cast<char*>(&value), sizeof(T));
  if (!stream) throw FileError("the saved scene is truncated in its " + what);
  return value;
}

/// Reads what write_array() wrote. @throws FileError naming `what` if the stream ends or the count is not in [min_count, max_count].
template <class T>
std::vector<T> read_array(std::istream& stream, const std::string& what, std::uint64_t min_count, std::uint64_t max_count) {
  const auto count = read_value<std::uint64_t>(stream, what);
  if (count < min_count || count > max_count) {
    throw FileError("the saved scene has " + std::to_string(count) + " " + what + ", expected " + std::to_string(min_count) + " to " +
                    std::to_string(max_count));
  }
  std::vector<T> values(count);
  stream.read(reinterpret_cast<char*>(values.data()), static_cast<std::streamsize>(count * sizeof(T)));
  if (!stream) throw FileError("the saved scene is truncated in its " + what);
  return values;
}

}  // namespace foothold

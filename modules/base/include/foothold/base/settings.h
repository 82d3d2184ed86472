// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// Settings as plain structs, each with one list of fields from which everything else follows: parsing, printing, help, tables, validation.
///
/// A settings struct declares
///
///     template <class Visitor> static void fields(Visitor& v) {
///       v(&PoseSettings::num_hypotheses, "num_hypotheses", "Hypotheses kept before the first cull (P).", Range{1, 65536});
///       v(&RelocaliserSettings::pose, "pose");                 // a nested struct
///     }
///
/// and is addressed by paths such as "pose.num_hypotheses".
#pragma once

#include <limits>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "foothold/base/error.h"

namespace foothold {

/// The closed interval of values allowed for a number.
struct Range {
  double low = 0.0;   ///< the least allowed value
  double high = 0.0;  ///< the greatest allowed value
};

/// One field of a settings struct, as text.
struct SettingDescription {
  std::string path;   ///< e.g. "pose.num_hypotheses"
  std::string value;  ///< current value, as parse accepts it
  std::string range;  ///< e.g. "[1, 65536]"; "true or false" for booleans; empty for text
  std::string help;   ///< one sentence
};

namespace detail {
std::string to_text(bool value);
std::string to_text(double value);
std::string to_text(float value);
std::string to_text(long long value);
std::string to_text(unsigned long long value);
std::string range_text(const Range& range);
bool parse_bool(const std::string& path, const std::string& text);
/// Parses a number completely and checks it against a range. @throws InvalidSettings
double parse_number(const std::string& path, const std::string& text, const Range& range, bool integer);
/// Parses a number from 0 to `max` completely. @throws InvalidSettings
unsigned long long parse_unsigned(const std::string& path, const std::string& text, unsigned long long max);
void check_range(const std::string& path, double value, const Range& range);
/// The same in single precision, for 0.1F is greater than 0.1.
void check_range(const std::string& path, float value, const Range& range);
[[noreturn]] void throw_unknown_setting(const std::string& path, const std::vector<SettingDescription>& known);

template <class T>
inline constexpr bool kIsLeaf = std::is_arithmetic_v<T> || std::is_same_v<T, std::string>;

template <class T>
std::string field_text(const T& value) {
  if constexpr (std::is_same_v<T, std::string>) {
    return value;
  } else if constexpr (std::is_same_v<T, bool> || std::is_floating_point_v<T>) {
    return to_text(value);
  } else if constexpr (std::is_signed_v<T>) {
    return to_text(static_cast<long long>(value));
  } else {
    return to_text(static_cast<unsigned long long>(value));
  }
}

template <class T>
void parse_field(const std::string& path, const std::string& text, const Range& range, T& value) {
  if constexpr (std::is_same_v<T, std::string>) {
    value = text;
  } else if constexpr (std::is_same_v<T, bool>) {
    value = parse_bool(path, text);
  } else if constexpr (std::is_unsigned_v<T>) {
    value = static_cast<T>(parse_unsigned(path, text, std::numeric_limits<T>::max()));
    check_range(path, static_cast<double>(value), range);
  } else {
    value = static_cast<T>(parse_number(path, text, range, std::is_integral_v<T>));
  }
}

/// Walks the fields of a settings object, calling leaf(path, value, help, range) for each.
template <class Settings, class Leaf>
struct FieldWalker {
  Settings& settings;
  Leaf& leaf;
  std::string prefix;

  template <class Owner, class T>
  void operator()(T Owner::*member, const char* name, const char* help = "", Range range = {}) {
    auto& value = settings.*member;
    if constexpr (kIsLeaf<T>) {
      leaf(prefix + name, value, help, range);
    } else {
      FieldWalker<std::remove_reference_t<decltype(value)>, Leaf> nested{value, leaf, prefix + name + "."};
      std::remove_const_t<T>::fields(nested);
    }
  }
};

template <class Settings, class Leaf>
void walk_fields(Settings& settings, Leaf leaf) {
  FieldWalker<Settings, Leaf> walker{settings, leaf, ""};
  std::remove_const_t<Settings>::fields(walker);
}
}  // namespace detail

/// Every field of a settings object with its path, value, range and help, in declaration order.
template <class Settings>
std::vector<SettingDescription> describe_settings(const Settings& settings) {
  std::vector<SettingDescription> result;
  detail::walk_fields(settings, [&](const std::string& path, const auto& value, const char* help, const Range& range) {
    using T = std::decay_t<decltype(value)>;
    std::string range_text;
    if constexpr (std::is_same_v<T, bool>) {
      range_text = "true or false";
    } else if constexpr (!std::is_same_v<T, std::string>) {
      range_text = detail::range_text(range);
    }
    result.push_back({path, detail::field_text(value), range_text, help});
  });
  return result;
}

/// Sets the field at a path from text. @throws InvalidSettings for an unknown path (with the nearest known one) or a bad value.
template <class Settings>
void assign_setting(Settings& settings, const std::string& path, const std::string& text) {
  bool found = false;
  detail::walk_fields(settings, [&](const std::string& field, auto& value, const char*, const Range& range) {
    if (field != path) return;
    detail::parse_field(path, text, range, value);
    found = true;
  });
  if (!found) detail::throw_unknown_setting(path, describe_settings(settings));
}

/// Checks every number against its range. @throws InvalidSettings naming the field, its value and its range.
template <class Settings>
void validate_settings(const Settings& settings) {
  detail::walk_fields(settings, [](const std::string& path, const auto& value, const char*, const Range& range) {
    using T = std::decay_t<decltype(value)>;
    if constexpr (std::is_same_v<T, float>) {
      detail::check_range(path, value, range);
    } else if constexpr (std::is_arithmetic_v<T> && !std::is_same_v<T, bool>) {
      detail::check_range(path, static_cast<double>(value), range);
    }
  });
}

}  // namespace foothold

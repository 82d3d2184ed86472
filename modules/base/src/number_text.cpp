// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "foothold/base/number_text.h"

#include <array>
#include <charconv>
#include <limits>

#include "foothold/base/contract.h"

namespace foothold {
namespace {

constexpr int kMaxDigits = 17;

std::string text_of(double value, std::chars_format format, int precision) {
  FOOTHOLD_EXPECTS(precision >= 0 && precision <= kMaxDigits);
  std::array<char, std::numeric_limits<double>::max_exponent10 + kMaxDigits + 8> text{};
  return {text.data(), std::to_chars(text.data(), text.data() + text.size(), value, format, precision).ptr};
}

}  // namespace

std::string general_text(double value, int num_digits) { return text_of(value, std::chars_format::general, num_digits); }

std::string fixed_text(double value, int num_decimals) { return text_of(value, std::chars_format::fixed, num_decimals); }

}  // namespace foothold

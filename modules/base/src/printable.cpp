// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "foothold/base/printable.h"

namespace foothold {

std::string printable(std::string_view text, std::size_t max_characters) {
  constexpr char kDigits[] = "0123456789abcdef";
  std::string result;
  for (const char c : text.substr(0, max_characters)) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte >= 0x20 && byte < 0x7f) {
      result += c;
    } else {
      result += {'\\', 'x', kDigits[byte >> 4U], kDigits[byte & 15U]};
    }
  }
  if (text.size() > max_characters) result += "...";
  return result;
}

std::string in_quotes(std::string_view text) {
  constexpr std::size_t kMaxLength = 60;
  std::string result = "'";
  for (const char c : text.substr(0, kMaxLength)) result += static_cast<unsigned char>(c) < 0x20 || c == 0x7f ? '?' : c;
  return result + (text.size() > kMaxLength ? "...'" : "'");
}

}  // namespace foothold

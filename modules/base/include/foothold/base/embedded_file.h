// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// Files that are part of a library: made by foothold_embed_file() of cmake/EmbedFile.cmake.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

namespace foothold {

/// The bytes of a file, eight to a word, the first in the lowest bits.
struct EmbeddedFile {
  const std::uint64_t* words = nullptr;  ///< the words of the file
  std::size_t num_bytes = 0;             ///< of the file, without what fills the last word

  /// The file as a string.
  std::string bytes() const {
    std::string text(num_bytes, '\0');
    for (std::size_t i = 0; i < num_bytes; ++i) text[i] = static_cast<char>(static_cast<unsigned char>(words[i / 8] >> (8 * (i % 8))));
    return text;
  }
};

}  // namespace foothold

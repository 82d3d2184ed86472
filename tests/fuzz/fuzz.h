// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// What fuzz targets share.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

#include "foothold/base/error.h"

/// libFuzzer's entry point.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace foothold::fuzz {

/// The input as text.
inline std::string text_of(const std::uint8_t* data, std::size_t size) { return {reinterpret_cast<const char*>(data), size}; }

/// Inputs that attempt() saw accepted so far.
inline int num_accepted = 0;

/// Runs a parser, which may complain about its input only through the library's exceptions.
template <class Parse>
void attempt(Parse&& parse) {
  try {
    parse();
    ++num_accepted;
  } catch (const Error&) {
  }
}

/// Stops the run where a parser accepted what it should not have.
inline void require(bool condition) {
  if (!condition) __builtin_trap();
}

}  // namespace foothold::fuzz

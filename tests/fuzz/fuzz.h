// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// What fuzz targets share.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <string>

#include "foothold/base/error.h"

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

/// A fuzz target: whatever the input of `size` bytes, the result is 0.
using Target = int (*)(const std::uint8_t* data, std::size_t size);

/// All targets of the program that replays corpora, by name.
inline std::map<std::string, Target>& targets() {
  static std::map<std::string, Target> all;
  return all;
}

}  // namespace foothold::fuzz

/// Begins the definition of a fuzz target, whose body sees `data` and `size`: libFuzzer's entry point, or one of the targets that
/// replay_main.cpp knows.
#ifdef FOOTHOLD_FUZZ_REPLAY
#define FOOTHOLD_FUZZ_TARGET(name)                                                                  \
  static int fuzz_##name(const std::uint8_t* data, std::size_t size);                               \
  static const bool kHasFuzz_##name = foothold::fuzz::targets().emplace(#name, fuzz_##name).second; \
  static int fuzz_##name(const std::uint8_t* data, std::size_t size)
#else
#define FOOTHOLD_FUZZ_TARGET(name) extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
#endif

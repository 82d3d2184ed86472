// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// How libFuzzer changes files in the form of docs/binary-format.md: mostly the contents of one of their data, so that the form holds.
#include <algorithm>
#include <random>

#include "checked_file.h"
#include "fuzz.h"

extern "C" std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t max_size);

namespace foothold::fuzz {
namespace {

/// @param max_bytes  Of the result.
std::string mutated(std::string bytes, std::size_t max_bytes, std::minstd_rand& random) {
  constexpr unsigned kOneInSoMany = 16;
  CheckedFile file = taken_apart(bytes);
  if (file.data.empty() || random() % kOneInSoMany == 0) {
    const std::size_t size = std::min(bytes.size(), max_bytes);
    bytes.resize(max_bytes);
    bytes.resize(LLVMFuzzerMutate(reinterpret_cast<std::uint8_t*>(bytes.data()), size, max_bytes));
    return bytes;
  }
  const std::size_t chosen = random() % file.data.size();
  const std::size_t num_others = bytes.size() - file.data[chosen].contents.size();
  const auto place = file.data.begin() + static_cast<std::ptrdiff_t>(chosen);
  if (random() % kOneInSoMany == 0) {
    file.data.erase(place);
  } else if (random() % kOneInSoMany == 0) {
    file.data.insert(place, CheckedData(*place));
  } else if (num_others < max_bytes) {
    place->contents = mutated(place->contents, max_bytes - num_others, random);
  }
  return put_together(file, Chain::kNone);
}

}  // namespace
}  // namespace foothold::fuzz

extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size, std::size_t max_size, unsigned seed) {
  using namespace foothold::fuzz;
  std::minstd_rand random(seed);
  const std::string bytes = mutated(text_of(data, size), max_size, random);
  const std::size_t num_bytes = std::min(bytes.size(), max_size);
  std::copy_n(bytes.begin(), num_bytes, data);
  return num_bytes;
}

// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// Parts of binary files, alone.
#pragma once

#include <sstream>
#include <string>

#include "foothold/base/checked_stream.h"

namespace foothold::test {

inline constexpr BinaryFormat kPartFormat{"part of a test", "FHTESTS\n", 1};

/// Where the contents of a small part begin: behind magic, version and the length of the first piece.
inline constexpr std::size_t kContents = 16;

/// What write(CheckedWriter&) writes.
template <class Write>
std::string checked_bytes(const Write& write) {
  std::ostringstream stream;
  CheckedWriter writer(stream, kPartFormat);
  write(writer);
  writer.finish();
  return stream.str();
}

/// Lets read(CheckedReader&) read all of it.
template <class Read>
void read_checked(const std::string& bytes, const Read& read) {
  std::istringstream stream(bytes);
  CheckedReader reader(stream, kPartFormat);
  read(reader);
  reader.finish();
}

}  // namespace foothold::test

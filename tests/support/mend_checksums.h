// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// A forger of binary files: damage that checksums do not show.
#pragma once

#include <cstdint>
#include <cstring>
#include <string>

#include "foothold/base/checksum.h"

namespace foothold::test {

/// Walks data in the form of docs/binary-format.md, and writes the checksums that its pieces should have.
/// @param place  Where the data begins; receives where it ends, the end of the bytes if they are cut short.
/// @param chain  The checksum of what comes before.
/// @return The checksum with which what follows goes on.
inline std::uint64_t mend_checksums(std::string& bytes, std::size_t& place, std::uint64_t chain = kFnvBasis) {
  constexpr std::size_t kHeadBytes = 12;
  std::uint64_t checksum = chain;
  std::size_t end = place + kHeadBytes;
  if (end <= bytes.size()) checksum = fnv1a(chain, &bytes[place], kHeadBytes);
  for (std::uint32_t size = 1; size != 0;) {
    place = bytes.size();
    if (end + sizeof(size) > bytes.size()) return checksum;
    std::memcpy(&size, &bytes[end], sizeof(size));
    const std::size_t after = end + sizeof(size) + size + sizeof(checksum);
    if (after > bytes.size()) return checksum;
    checksum = fnv1a(checksum, &bytes[end], sizeof(size) + size);
    std::memcpy(&bytes[after - sizeof(checksum)], &checksum, sizeof(checksum));
    end = after;
  }
  place = end;
  return checksum;
}

/// Data that is all that the bytes hold, with right checksums.
inline std::string with_right_checksums(std::string bytes) {
  std::size_t place = 0;
  mend_checksums(bytes, place);
  return bytes;
}

}  // namespace foothold::test

// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// Files in the form of docs/binary-format.md taken apart and put together with right checksums, so that damaged contents get past them.
#pragma once

#include <cstdint>
#include <cstring>
#include <sstream>
#include <string>
#include <vector>

#include "foothold/base/checked_stream.h"

namespace foothold::fuzz {

/// With which checksum data begins that is not the first of its file.
enum class Chain { kNone, kOfFirst, kOfPrevious };

/// Magic and version, and what all pieces hold.
struct CheckedData {
  std::string head;
  std::string contents;
};

struct CheckedFile {
  std::vector<CheckedData> data;
  std::string rest;  ///< behind the last data that is whole
};

inline constexpr std::size_t kMagicBytes = 8;
inline constexpr std::size_t kHeadBytes = kMagicBytes + sizeof(std::uint32_t);

/// True where data begins: all of Foothold's magics start with "FH" and are text.
inline bool is_checked_data(const std::string& bytes, std::size_t place = 0) {
  return place + kHeadBytes <= bytes.size() && bytes.compare(place, 2, "FH") == 0 && bytes.find('\0', place) >= place + kMagicBytes;
}

/// Reads data whatever its checksums say. @param place  Moves behind it. @return False if it ends early.
inline bool take_data(const std::string& bytes, std::size_t& place, CheckedData& data) {
  if (!is_checked_data(bytes, place)) return false;
  data.head = bytes.substr(place, kHeadBytes);
  std::size_t end = place + kHeadBytes;
  for (std::uint32_t num_bytes = 1; num_bytes != 0;) {
    if (end + sizeof(num_bytes) > bytes.size()) return false;
    std::memcpy(&num_bytes, &bytes[end], sizeof(num_bytes));
    end += sizeof(num_bytes);
    if (num_bytes + sizeof(std::uint64_t) > bytes.size() - end) return false;
    data.contents.append(bytes, end, num_bytes);
    end += num_bytes + sizeof(std::uint64_t);
  }
  place = end;
  return true;
}

inline CheckedFile taken_apart(const std::string& bytes) {
  CheckedFile file;
  std::size_t place = 0;
  for (CheckedData data; take_data(bytes, place, data); data = {}) file.data.push_back(data);
  file.rest = bytes.substr(place);
  return file;
}

/// Data within data, as in the parts of a scene, is put together first.
inline std::string put_together(const CheckedFile& file, Chain chain) {
  std::ostringstream stream;
  std::uint64_t first = kFnvBasis;
  std::uint64_t previous = kFnvBasis;
  for (std::size_t i = 0; i < file.data.size(); ++i) {
    const CheckedData& data = file.data[i];
    const std::string contents = is_checked_data(data.contents) ? put_together(taken_apart(data.contents), Chain::kNone) : data.contents;
    const std::string magic = data.head.substr(0, kMagicBytes);
    std::uint32_t version = 0;
    std::memcpy(&version, &data.head[kMagicBytes], sizeof(version));
    const std::uint64_t begin = i == 0 || chain == Chain::kNone ? kFnvBasis : (chain == Chain::kOfFirst ? first : previous);
    CheckedWriter writer(stream, {"", magic.c_str(), version}, begin);
    writer.write_bytes(contents.data(), contents.size());
    previous = writer.finish();
    if (i == 0) first = previous;
  }
  return stream.str() + file.rest;
}

/// The same bytes with right checksums.
inline std::string mended(const std::string& bytes, Chain chain = Chain::kNone) { return put_together(taken_apart(bytes), chain); }

}  // namespace foothold::fuzz

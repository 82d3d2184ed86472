// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// The one form in which Foothold writes binary data: versioned, in checksummed pieces, never read further than it was checked.
///
/// Little-endian, without padding (docs/binary-format.md):
///
///     8 bytes of magic | u32 version | pieces: u32 N, N bytes of contents, u64 checksum | ... | the last piece has N = 0
///
/// The checksum is FNV-1a of magic, version, and the lengths and contents of all pieces so far.
#pragma once

#include <algorithm>
#include <cstdint>
#include <iosfwd>
#include <memory>
#include <string>
#include <type_traits>
#include <vector>

#include "foothold/base/checksum.h"
#include "foothold/base/error.h"
#include "foothold/base/se3.h"
#include "foothold/base/span.h"

namespace foothold {

/// What a kind of data begins with, and how messages call it.
struct BinaryFormat {
  const char* name;       ///< such as "forest"
  const char* magic;      ///< 8 characters
  std::uint32_t version;  ///< of what is written, and the only one that is read
};

/// Bytes of contents in a piece at most.
inline constexpr std::uint32_t kMaxPieceBytes = 1U << 20U;

/// The length of data in this form with `num_bytes` of contents.
constexpr std::uint64_t checked_size(std::uint64_t num_bytes) {
  constexpr std::uint64_t kHeadBytes = 12;
  constexpr std::uint64_t kBytesPerPiece = 12;
  return kHeadBytes + num_bytes + ((num_bytes + kMaxPieceBytes - 1) / kMaxPieceBytes + 1) * kBytesPerPiece;
}

/// The data ends in the middle: what an interrupted writer leaves.
class TruncatedFile : public FileError {
 public:
  using FileError::FileError;
};

/// Writes data of one format. It is complete once finish() has returned.
///
/// Neither the stream's exceptions() nor its position matter. Every function throws FileError if the stream fails.
class CheckedWriter {
 public:
  /// Begins where the stream stands. @param chain  checksum of what came before, so that data of other origin does not pass as what
  /// follows.
  CheckedWriter(std::ostream& stream, const BinaryFormat& format, std::uint64_t chain = kFnvBasis);
  ~CheckedWriter();
  CheckedWriter(const CheckedWriter&) = delete;
  CheckedWriter& operator=(const CheckedWriter&) = delete;

  /// Writes bytes as they are.
  void write_bytes(const void* data, std::size_t num_bytes);

  /// Writes a value as its bytes.
  template <class T>
  void write(const T& value) {
    static_assert(std::is_trivially_copyable_v<T>, "written as bytes");
    write_bytes(&value, sizeof(T));
  }

  /// Writes a count (u64) and the elements' bytes.
  template <class T>
  void write_array(Span<const T> values) {
    static_assert(std::is_trivially_destructible_v<T>, "written as bytes");
    write(static_cast<std::uint64_t>(values.size()));
    write_bytes(values.data(), values.size() * sizeof(T));
  }
  /// Writes a count (u64) and the elements' bytes.
  template <class T>
  void write_array(const std::vector<T>& values) {
    write_array(Span<const T>(values));
  }
  /// Writes a count (u64) and the characters.
  void write_text(const std::string& text) { write_array(Span<const char>(text)); }

  /// Writes the rotation by columns, then the translation: 12 floats.
  void write_transform(const SE3& transform) {
    write_bytes(transform.rotation.data(), 9 * sizeof(float));
    write_bytes(transform.translation.data(), 3 * sizeof(float));
  }

  /// Contents as a stream, for what does not know this class. Failures show in finish().
  std::ostream& stream();

  /// Writes what is left and the end. @return The checksum, with which to chain more data.
  std::uint64_t finish();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// Reads what CheckedWriter wrote, and nothing behind it. No byte is handed out before its checksum was found right.
///
/// Neither the stream's exceptions() nor its state afterwards matter. Every function throws FileError, beginning with `source`, for data
/// that is damaged, cut short (TruncatedFile), of another kind or version.
class CheckedReader {
 public:
  /// Reads magic and version. @param source  how messages call the data, such as a file's path; empty for the format's name.
  CheckedReader(std::istream& stream, const BinaryFormat& format, const std::string& source = {}, std::uint64_t chain = kFnvBasis);
  ~CheckedReader();
  CheckedReader(const CheckedReader&) = delete;
  CheckedReader& operator=(const CheckedReader&) = delete;

  /// @param what  names the contents in messages.
  void read_bytes(void* data, std::size_t num_bytes, const char* what);

  /// Reads a value from its bytes.
  template <class T>
  T read(const char* what) {
    static_assert(std::is_trivially_copyable_v<T>);
    T value{};
    read_bytes(&value, sizeof(T), what);
    return value;
  }

  /// Reads a count, which must be in [min_count, max_count], and that many elements. Takes memory only as data arrives.
  template <class T>
  std::vector<T> read_array(const char* what, std::uint64_t min_count, std::uint64_t max_count) {
    const auto count = read<std::uint64_t>(what);
    check_range(what, count, min_count, max_count);
    return read_items<T>(what, count);
  }
  /// Reads elements without a count. Takes memory only as data arrives.
  template <class T>
  std::vector<T> read_items(const char* what, std::uint64_t count) {
    static_assert(std::is_trivially_destructible_v<T>, "read as bytes");
    constexpr std::uint64_t kStep = std::max<std::uint64_t>(1, kMaxPieceBytes / sizeof(T));
    std::vector<T> values;
    while (values.size() < count) {
      const std::size_t begin = values.size();
      values.resize(begin + std::min<std::uint64_t>(kStep, count - begin));
      read_bytes(&values[begin], (values.size() - begin) * sizeof(T), what);
    }
    return values;
  }
  /// Reads what write_text() wrote, of at most max_bytes.
  std::string read_text(const char* what, std::uint64_t max_bytes);
  /// @throws FileError also for a transform that is not rigid.
  SE3 read_transform(const char* what);

  /// Contents as a stream, for what does not know this class. It ends where the contents end, and where check() would throw.
  std::istream& stream();
  /// Throws the error that stream() met, if any.
  void check() const;

  /// Reads the end. @return The checksum, with which to chain more data. @throws FileError also for contents that were not read.
  std::uint64_t finish();
  /// For files that hold nothing else. @throws FileError if the stream goes on behind the data. @pre finish() was called.
  void expect_end_of_file() const;

  /// Throws FileError unless min <= value <= max.
  void check_range(const char* what, std::uint64_t value, std::uint64_t min, std::uint64_t max) const;
  /// Throws FileError(source: what).
  [[noreturn]] void refuse(const std::string& what) const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace foothold

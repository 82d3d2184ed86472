// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "foothold/base/checked_stream.h"

#include <cstring>
#include <istream>
#include <ostream>
#include <streambuf>

#include "foothold/base/contract.h"
#include "foothold/base/printable.h"

namespace foothold {
namespace {

constexpr std::size_t kMagicBytes = 8;

/// Reads from the buffer below a stream, whose own state would throw if its exceptions are on. @return The number of bytes read.
std::size_t get_bytes(std::istream& stream, void* data, std::size_t num_bytes) {
  if (!stream || stream.rdbuf() == nullptr) return 0;
  try {
    return static_cast<std::size_t>(stream.rdbuf()->sgetn(static_cast<char*>(data), static_cast<std::streamsize>(num_bytes)));
  } catch (const std::ios_base::failure&) {
    return 0;  // a file that cannot be read
  }
}

bool put_bytes(std::ostream& stream, const void* data, std::size_t num_bytes) {
  if (!stream || stream.rdbuf() == nullptr) return false;
  try {
    const auto size = static_cast<std::streamsize>(num_bytes);
    return stream.rdbuf()->sputn(static_cast<const char*>(data), size) == size;
  } catch (const std::ios_base::failure&) {
    return false;
  }
}

std::uint64_t begin_checksum(const BinaryFormat& format, std::uint64_t chain) {
  FOOTHOLD_EXPECTS(std::strlen(format.magic) == kMagicBytes);
  return fnv1a(fnv1a(chain, format.magic, kMagicBytes), &format.version, sizeof(format.version));
}

}  // namespace

struct CheckedWriter::State : std::streambuf {
  State(std::ostream& used_stream, const BinaryFormat& used_format, std::uint64_t chain)
      : file(used_stream), format(used_format), checksum(begin_checksum(used_format, chain)) {
    if (!put_bytes(file, format.magic, kMagicBytes) || !put_bytes(file, &format.version, sizeof(format.version))) fail();
  }

  [[noreturn]] void fail() {
    has_failed = true;
    throw FileError(std::string(format.name) + ": could not be written: the stream failed; is the disk full?");
  }

  void write_piece() {
    const auto size = static_cast<std::uint32_t>(piece.size());
    checksum = fnv1a(fnv1a(checksum, &size, sizeof(size)), piece.data(), piece.size());
    if (has_failed || !put_bytes(file, &size, sizeof(size)) || !put_bytes(file, piece.data(), piece.size()) ||
        !put_bytes(file, &checksum, sizeof(checksum))) {
      fail();
    }
    piece.clear();
  }

  void append(const char* data, std::size_t num_bytes) {
    while (num_bytes != 0) {
      const std::size_t step = std::min<std::size_t>(num_bytes, kMaxPieceBytes - piece.size());
      piece.append(data, step);
      data += step;
      num_bytes -= step;
      if (piece.size() == kMaxPieceBytes) write_piece();
    }
  }

  // What arrives through stream(): the stream above turns exceptions into its own state, and finish() tells.
  std::streamsize xsputn(const char* data, std::streamsize num_bytes) override {
    append(data, static_cast<std::size_t>(num_bytes));
    return num_bytes;
  }
  int_type overflow(int_type c) override {
    const char byte = traits_type::to_char_type(c);
    if (!traits_type::eq_int_type(c, traits_type::eof())) append(&byte, 1);
    return traits_type::not_eof(c);
  }

  std::ostream& file;
  BinaryFormat format;
  std::uint64_t checksum;
  std::string piece;
  bool has_failed = false;
  std::ostream contents{this};
};

CheckedWriter::CheckedWriter(std::ostream& stream, const BinaryFormat& format, std::uint64_t chain)
    : state_(std::make_unique<State>(stream, format, chain)) {}

CheckedWriter::~CheckedWriter() = default;

void CheckedWriter::write_bytes(const void* data, std::size_t num_bytes) { state_->append(static_cast<const char*>(data), num_bytes); }

std::ostream& CheckedWriter::stream() { return state_->contents; }

std::uint64_t CheckedWriter::finish() {
  State& s = *state_;
  if (!s.contents) s.fail();
  if (!s.piece.empty()) s.write_piece();
  s.write_piece();  // of no bytes: the end
  if (s.file.rdbuf()->pubsync() == -1) s.fail();
  return s.checksum;
}

struct CheckedReader::State : std::streambuf {
  State(std::istream& used_stream, const BinaryFormat& format, const std::string& used_source, std::uint64_t chain)
      : file(used_stream), source(used_source.empty() ? format.name : used_source), checksum(begin_checksum(format, chain)) {
    std::string magic(kMagicBytes, '\0');
    magic.resize(get_bytes(file, magic.data(), kMagicBytes));
    if (magic != std::string(format.magic).substr(0, magic.size())) {
      refuse("not a " + std::string(format.name) + " of Foothold: begins with '" + printable(magic) + "', expected '" +
             printable(format.magic) + "'");
    }
    std::uint32_t version = 0;
    get_whole(&version, sizeof(version), "version");
    if (version != format.version) {
      refuse("a " + std::string(format.name) + " of version " + std::to_string(version) + ", expected version " +
             std::to_string(format.version));
    }
  }

  [[noreturn]] void refuse(const std::string& what) const { throw FileError(source + ": " + what); }

  void get_whole(void* data, std::size_t num_bytes, const char* what) {
    const std::size_t num_read = get_bytes(file, data, num_bytes);
    if (num_read == num_bytes) return;
    throw TruncatedFile(source + ": ends early, in its " + what + ": expected " + std::to_string(num_bytes - num_read) + " more bytes");
  }

  /// Reads the next piece and checks it. @return False at the end.
  bool read_piece(const char* what) {
    if (has_ended) return false;
    std::uint32_t size = 0;
    get_whole(&size, sizeof(size), what);
    if (size > kMaxPieceBytes) {
      refuse("damaged, in its " + std::string(what) + ": got a piece of " + std::to_string(size) + " bytes, expected at most " +
             std::to_string(kMaxPieceBytes));
    }
    setg(nullptr, nullptr, nullptr);
    piece.resize(size);
    get_whole(piece.data(), size, what);
    std::uint64_t found = 0;
    get_whole(&found, sizeof(found), what);
    checksum = fnv1a(fnv1a(checksum, &size, sizeof(size)), piece.data(), size);
    if (found != checksum) {
      refuse("damaged, in its " + std::string(what) + ": checksum " + std::to_string(found) + ", expected " + std::to_string(checksum));
    }
    setg(piece.data(), piece.data(), piece.data() + size);
    has_ended = size == 0;
    return !has_ended;
  }

  bool has_contents() const { return gptr() != egptr(); }

  void read(char* data, std::size_t num_bytes, const char* what) {
    while (num_bytes != 0) {
      if (gptr() == egptr() && !read_piece(what)) {
        refuse("ends early, in its " + std::string(what) + ": expected " + std::to_string(num_bytes) + " more bytes");
      }
      const std::size_t step = std::min(num_bytes, static_cast<std::size_t>(egptr() - gptr()));
      std::memcpy(data, gptr(), step);
      setg(eback(), gptr() + step, egptr());
      data += step;
      num_bytes -= step;
    }
  }

  int_type underflow() override {
    if (!error.empty()) return traits_type::eof();
    try {
      return read_piece("contents") ? traits_type::to_int_type(*gptr()) : traits_type::eof();
    } catch (const FileError& damage) {
      error = damage.what();
      return traits_type::eof();
    }
  }

  std::istream& file;
  std::string source;
  std::uint64_t checksum;
  std::vector<char> piece;
  bool has_ended = false;
  std::string error;  ///< what stream() met
  std::istream contents{this};
};

CheckedReader::CheckedReader(std::istream& stream, const BinaryFormat& format, const std::string& source, std::uint64_t chain)
    : state_(std::make_unique<State>(stream, format, source, chain)) {}

CheckedReader::~CheckedReader() = default;

void CheckedReader::read_bytes(void* data, std::size_t num_bytes, const char* what) {
  state_->read(static_cast<char*>(data), num_bytes, what);
}

std::string CheckedReader::read_text(const char* what, std::uint64_t max_bytes) {
  const std::vector<char> characters = read_array<char>(what, 0, max_bytes);
  return {characters.begin(), characters.end()};
}

SE3 CheckedReader::read_transform(const char* what) {
  SE3 transform;
  read_bytes(transform.rotation.data(), 9 * sizeof(float), what);
  read_bytes(transform.translation.data(), 3 * sizeof(float), what);
  if (!is_rigid(transform)) refuse("damaged: its " + std::string(what) + " is not rigid, expected a rotation and a finite translation");
  return transform;
}

std::istream& CheckedReader::stream() { return state_->contents; }

void CheckedReader::check() const {
  if (!state_->error.empty()) throw FileError(state_->error);
}

std::uint64_t CheckedReader::finish() {
  check();
  if (state_->has_contents() || state_->read_piece("end")) refuse("goes on where its end was expected");
  return state_->checksum;
}

void CheckedReader::expect_end_of_file() const {
  char byte = 0;
  if (get_bytes(state_->file, &byte, 1) != 0) refuse("goes on behind its end: expected nothing more");
}

void CheckedReader::check_range(const char* what, std::uint64_t value, std::uint64_t min, std::uint64_t max) const {
  if (value >= min && value <= max) return;
  const std::string expected = min == max ? std::to_string(min) : std::to_string(min) + " to " + std::to_string(max);
  refuse("got " + std::to_string(value) + " " + what + ", expected " + expected);
}

void CheckedReader::refuse(const std::string& what) const { state_->refuse(what); }

}  // namespace foothold

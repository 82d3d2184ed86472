// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "scene_stream.h"

#include "foothold/base/binary_stream.h"
#include "foothold/base/checksum.h"

namespace foothold::io {
namespace {

template <class T>
bool read_raw(std::istream& file, T& value) {
  file.read(reinterpret_cast<char*>(&value), sizeof(T));
  return static_cast<bool>(file);
}

}  // namespace

PieceWriter::PieceWriter(std::ostream& file, std::uint64_t& checksum) : file_(file), checksum_(checksum), buffer_(kMaxPieceBytes) {
  setp(buffer_.data(), buffer_.data() + buffer_.size());
}

void PieceWriter::write_piece() {
  const auto size = static_cast<std::uint32_t>(pptr() - pbase());
  checksum_ = fnv1a(fnv1a(checksum_, &size, sizeof(size)), pbase(), size);
  write_value(file_, size);
  file_.write(pbase(), size);
  write_value(file_, checksum_);
  setp(buffer_.data(), buffer_.data() + buffer_.size());
}

PieceWriter::int_type PieceWriter::overflow(int_type c) {
  write_piece();
  if (!file_) return traits_type::eof();
  if (!traits_type::eq_int_type(c, traits_type::eof())) {
    *pptr() = traits_type::to_char_type(c);
    pbump(1);
  }
  return traits_type::not_eof(c);
}

void PieceWriter::finish() {
  if (pptr() != pbase()) write_piece();
  write_piece();  // of no bytes: the end mark
}

bool PieceReader::read_piece() {
  std::uint32_t size = 0;
  if (!read_raw(file_, size)) {
    error_ = "ends early, expected more pieces";
    return false;
  }
  if (size > kMaxPieceBytes) {
    error_ = "damaged: got a piece of " + std::to_string(size) + " bytes, expected at most " + std::to_string(kMaxPieceBytes);
    return false;
  }
  buffer_.resize(size);
  file_.read(buffer_.data(), size);
  std::uint64_t found = 0;
  if (!file_ || !read_raw(file_, found)) {
    error_ = "ends early, in a piece of " + std::to_string(size) + " bytes";
    return false;
  }
  checksum_ = fnv1a(fnv1a(checksum_, &size, sizeof(size)), buffer_.data(), size);
  if (found == checksum_) return true;
  error_ = "damaged: checksum " + std::to_string(found) + ", expected " + std::to_string(checksum_);
  return false;
}

PieceReader::int_type PieceReader::underflow() {
  if (ended_ || !error_.empty()) return traits_type::eof();
  if (!read_piece()) return traits_type::eof();
  ended_ = buffer_.empty();
  setg(buffer_.data(), buffer_.data(), buffer_.data() + buffer_.size());
  return ended_ ? traits_type::eof() : traits_type::to_int_type(*gptr());
}

}  // namespace foothold::io
